// A scratch file for temporary data: an append-only file, on disk or in memory, that can free single blocks.
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

/// A counter of the temporary space of all scratch files of a build. It reports each change to `progress`.
class TemporarySpace {
public:
    explicit TemporarySpace(Progress& progress) : progress_(progress) {}

    void take(std::uint64_t bytes);
    void giveBack(std::uint64_t bytes);

    /// Counts bytes that other processes wrote in the same space. This process may have freed such bytes before, so
    /// that the sum can be negative for a while.
    void takeOfOthers(std::uint64_t bytes);

    std::uint64_t bytes() const { return static_cast<std::uint64_t>(std::max<std::int64_t>(bytes_, 0)); }

    std::uint64_t peakBytes() const { return peak_; }

    void countRead(std::uint64_t bytes) { read_ += bytes; }

    /// Limits the rate of reads and writes to `bytesPerSecond`, over all files and threads. The limit simulates a
    /// slower disk or network.
    void limitRate(std::uint64_t bytesPerSecond) { bytesPerSecond_ = bytesPerSecond; }

    /// Waits until the rate limit permits `bytes` more bytes. Returns at once if there is no limit.
    void pace(std::uint64_t bytes);

    std::uint64_t bytesRead() const { return read_; }

    /// Returns the number of bytes that this process ever wrote.
    std::uint64_t bytesWritten() const { return written_; }

private:
    Progress& progress_;
    std::atomic<std::int64_t> bytes_{0};
    std::atomic<std::uint64_t> peak_{0};
    std::atomic<std::uint64_t> read_{0};
    std::atomic<std::uint64_t> written_{0};
    std::uint64_t bytesPerSecond_ = 0;
    std::mutex paceMutex_;
    std::chrono::steady_clock::time_point free_; // time at which the last permitted transfer ends
};

/// A scratch file that any number of threads can append to and read at once.
class ScratchFile {
public:
    /// Creates a scratch file whose first byte has the offset `begin`.
    explicit ScratchFile(TemporarySpace& space, std::uint64_t begin = 0) : space_(space), end_(begin) {}

    virtual ~ScratchFile() = default;
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ScratchFile(ScratchFile&&) = delete;
    ScratchFile& operator=(ScratchFile&&) = delete;

    /// Appends `bytes` as one block. Throws Error if the disk is full.
    Block append(std::span<const std::byte> bytes);

    /// Reads `block` into `out`, which has the size of the block. Throws DamageError if the bytes differ from the
    /// appended bytes.
    void read(const Block& block, std::span<std::byte> out) const;

    /// Returns the bytes of `blocks`, one block after the other. Throws DamageError.
    std::vector<std::byte> read(std::span<const Block> blocks) const;

    /// Publishes the appended bytes to processes on other hosts. A file of one process does nothing.
    virtual void handOver() const {}

    /// Makes the bytes that other processes published readable in this process.
    virtual void reopenOthers() {}

    /// Flushes the data of `parts` to the device, so that a power cut does not lose them. A file of one part ignores
    /// this.
    virtual void sync(std::span<const std::uint32_t> /*parts*/) {}

    /// Frees the space of `block`. Its bytes are lost.
    void release(const Block& block);

    /// Returns the offset of the next appended byte.
    std::uint64_t end() const { return end_; }

protected:
    /// Reads from `file`. Throws DamageError if the file is too short.
    static void loadFrom(const File& file, std::uint64_t offset, std::span<std::byte> out);

    virtual void load(std::uint64_t offset, std::span<std::byte> out) const = 0;
    virtual void store(std::uint64_t offset, std::span<const std::byte> bytes) = 0;
    virtual void forget(std::uint64_t offset, std::uint64_t bytes) = 0;

    /// Returns the description of the byte at `offset` for error messages.
    virtual std::string placeText(std::uint64_t offset) const = 0;

    TemporarySpace& space() { return space_; }

private:
    TemporarySpace& space_;
    std::atomic<std::uint64_t> end_;
};

/// Creates a scratch file at `path`.
std::unique_ptr<ScratchFile> scratchOnDisk(const std::string& path, TemporarySpace& space);

/// Creates a scratch file in memory.
std::unique_ptr<ScratchFile> scratchInMemory(TemporarySpace& space);

} // namespace gnomon::scratch
