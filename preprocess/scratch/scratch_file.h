// Temporary bytes: a file that grows at its end and gives space back piece by piece, or the same in memory.
#pragma once

#include "core/file.h"
#include "core/progress.h"
#include "preprocess/scratch/block.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>

namespace gnomon::scratch {

/// How much temporary space is in use, over all scratch files of a build; every change is told to `progress`.
class TemporarySpace {
public:
    explicit TemporarySpace(Progress& progress) : progress_(progress) {}

    void take(std::uint64_t bytes);
    void giveBack(std::uint64_t bytes);

    /// What other processes took in the same space: theirs may have been given back here before.
    void takeOfOthers(std::uint64_t bytes);

    std::uint64_t bytes() const { return static_cast<std::uint64_t>(std::max<std::int64_t>(bytes_, 0)); }

    std::uint64_t peakBytes() const { return peak_; }

    void countRead(std::uint64_t bytes) { read_ += bytes; }

    /// From now on no more bytes a second are read and written, all files and threads together: what a slower disk or
    /// network would do, for those who want to know.
    void limitRate(std::uint64_t bytesPerSecond) { bytesPerSecond_ = bytesPerSecond; }

    /// Waits until the limit, if there is one, lets `bytes` more through.
    void pace(std::uint64_t bytes);

    std::uint64_t bytesRead() const { return read_; }

    /// All that was ever taken.
    std::uint64_t bytesWritten() const { return written_; }

private:
    Progress& progress_;
    std::atomic<std::int64_t> bytes_{0};
    std::atomic<std::uint64_t> peak_{0};
    std::atomic<std::uint64_t> read_{0};
    std::atomic<std::uint64_t> written_{0};
    std::uint64_t bytesPerSecond_ = 0;
    std::mutex paceMutex_;
    std::chrono::steady_clock::time_point free_; // when what was let through is through
};

/// Appended to and read by any number of threads at once.
class ScratchFile {
public:
    /// The first byte that is appended lies at `begin`.
    explicit ScratchFile(TemporarySpace& space, std::uint64_t begin = 0) : space_(space), end_(begin) {}

    virtual ~ScratchFile() = default;
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ScratchFile(ScratchFile&&) = delete;
    ScratchFile& operator=(ScratchFile&&) = delete;

    /// Appends `bytes` as one block. Throws Error if the disk is full.
    Block append(std::span<const std::byte> bytes);

    /// Fills `out`, which has the size of `block`, with its bytes. Throws DamageError if they are not those that were
    /// appended.
    void read(const Block& block, std::span<std::byte> out) const;

    /// Returns the bytes of `blocks`, one block after the other. Throws DamageError.
    std::vector<std::byte> read(std::span<const Block> blocks) const;

    /// Lets processes on other hosts read what this one has appended, where there are any.
    virtual void handOver() const {}

    /// Lets this process read what others have handed over.
    virtual void reopenOthers() {}

    /// Flushes the data of `parts` to the device, so that a power cut does not lose them. A file of one part ignores
    /// this.
    virtual void sync(std::span<const std::uint32_t> /*parts*/) {}

    /// Gives the space of `block` back; its bytes are lost.
    void release(const Block& block);

    /// Where the next bytes go.
    std::uint64_t end() const { return end_; }

protected:
    /// Reads from a file of this machine. Throws DamageError if the file is too short.
    static void loadFrom(const File& file, std::uint64_t offset, std::span<std::byte> out);

    virtual void load(std::uint64_t offset, std::span<std::byte> out) const = 0;
    virtual void store(std::uint64_t offset, std::span<const std::byte> bytes) = 0;
    virtual void forget(std::uint64_t offset, std::uint64_t bytes) = 0;

    /// Returns the text that errors use for the byte at `offset`.
    virtual std::string placeText(std::uint64_t offset) const = 0;

    TemporarySpace& space() { return space_; }

private:
    TemporarySpace& space_;
    std::atomic<std::uint64_t> end_;
};

/// A new file at `path`.
std::unique_ptr<ScratchFile> scratchOnDisk(const std::string& path, TemporarySpace& space);

std::unique_ptr<ScratchFile> scratchInMemory(TemporarySpace& space);

} // namespace gnomon::scratch
