// A scratch file for temporary data, on disk or in memory. It is append-only, but the space of single blocks can be
// freed.
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

/// Counts the temporary space of all scratch files of a build. It reports each change to `progress`.
class TemporarySpace {
public:
    explicit TemporarySpace(Progress& progress) : progress_(progress) {}

    void take(std::uint64_t bytes);
    void giveBack(std::uint64_t bytes);

    /// Adds bytes that other processes wrote to scratch files. This process may have freed these bytes earlier, so the
    /// total can be negative for a while.
    void takeOfOthers(std::uint64_t bytes);

    std::uint64_t bytes() const { return static_cast<std::uint64_t>(std::max<std::int64_t>(bytes_, 0)); }

    std::uint64_t peakBytes() const { return peak_; }

    void countRead(std::uint64_t bytes) { read_ += bytes; }

    /// Limits the rate of reads and writes together to `bytesPerSecond`. The limit simulates a slower disk or network.
    void limitRate(std::uint64_t bytesPerSecond) { bytesPerSecond_ = bytesPerSecond; }

    /// Waits until the rate limit permits the transfer of another `bytes` bytes. Returns at once if there is no limit.
    void pace(std::uint64_t bytes);

    std::uint64_t bytesRead() const { return read_; }

    /// Returns the number of bytes that this process has written to scratch files since its start.
    std::uint64_t bytesWritten() const { return written_; }

private:
    Progress& progress_;
    std::atomic<std::int64_t> bytes_{0};
    std::atomic<std::uint64_t> peak_{0};
    std::atomic<std::uint64_t> read_{0};
    std::atomic<std::uint64_t> written_{0};
    std::uint64_t bytesPerSecond_ = 0;
    std::mutex paceMutex_;
    std::chrono::steady_clock::time_point free_; // time at which the last permitted transfer would end
};

/// An append-only file for temporary data. Any number of threads can append to it and read it at the same time.
class ScratchFile {
public:
    /// Creates a scratch file whose first byte has the offset `begin`.
    explicit ScratchFile(TemporarySpace& space, std::uint64_t begin = 0) : space_(space), end_(begin) {}

    virtual ~ScratchFile() = default;
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ScratchFile(ScratchFile&&) = delete;
    ScratchFile& operator=(ScratchFile&&) = delete;

    /// Appends `bytes` as one block, and returns the location of the block. Throws Error, for example if the disk is
    /// full.
    Block append(std::span<const std::byte> bytes);

    /// Reads `block` into `out`, which must have the size of the block. Throws DamageError if the bytes differ from the
    /// bytes that were appended.
    void read(const Block& block, std::span<std::byte> out) const;

    /// Returns the bytes of `blocks`, one block after the other. Throws DamageError if they differ from the bytes that
    /// were appended.
    std::vector<std::byte> read(std::span<const Block> blocks) const;

    /// Makes the appended bytes readable by processes on other hosts. Does nothing if only one process uses the scratch
    /// file.
    virtual void handOver() const {}

    /// Prepares this process to read bytes that other processes have made readable with `handOver`.
    virtual void reopenOthers() {}

    /// Flushes the files of the given parts to the device, so that a power cut does not lose their data. A part is the
    /// file of one process. A scratch file with one part ignores `parts`.
    virtual void sync(std::span<const std::uint32_t> /*parts*/) {}

    /// Frees the disk space or memory of `block`. Its bytes can no longer be read.
    void release(const Block& block);

    /// Returns the offset of the next appended byte.
    std::uint64_t end() const { return end_; }

protected:
    /// Reads bytes at `offset` from `file` into `out`. Throws DamageError if the file is too short.
    static void loadFrom(const File& file, std::uint64_t offset, std::span<std::byte> out);

    virtual void load(std::uint64_t offset, std::span<std::byte> out) const = 0;
    virtual void store(std::uint64_t offset, std::span<const std::byte> bytes) = 0;
    virtual void forget(std::uint64_t offset, std::uint64_t bytes) = 0;

    /// Returns the location of the byte at `offset` as a text for error messages.
    virtual std::string placeText(std::uint64_t offset) const = 0;

    TemporarySpace& space() { return space_; }

private:
    TemporarySpace& space_;
    std::atomic<std::uint64_t> end_;
};

/// Creates a scratch file on disk at `path`.
std::unique_ptr<ScratchFile> scratchOnDisk(const std::string& path, TemporarySpace& space);

/// Creates a scratch file in memory.
std::unique_ptr<ScratchFile> scratchInMemory(TemporarySpace& space);

} // namespace gnomon::scratch
