// The scratch files of all processes of a build. Each process appends only to its own file (its part), and reads the
// files of all processes.
#pragma once

#include "preprocess/scratch/scratch_file.h"

#include <map>
#include <memory>
#include <mutex>

namespace gnomon::scratch {

/// The number of bits of an offset within the scratch file of one process (a part). A global position has the part
/// number in the upper 16 bits and the offset within the part in the lower 48 bits.
constexpr unsigned kPartShift = 48;

/// The max number of scratch files (parts) of a build, counted over all processes that ever worked on it.
constexpr std::uint32_t kMaxParts = 1U << (64U - kPartShift);

/// The max size in bytes of the scratch file of one process.
constexpr std::uint64_t kMaxPartBytes = std::uint64_t{1} << kPartShift;

constexpr std::uint32_t partOf(std::uint64_t place) {
    return static_cast<std::uint32_t>(place >> kPartShift);
}

constexpr std::uint64_t placeOf(std::uint32_t part, std::uint64_t offset) {
    return (std::uint64_t{part} << kPartShift) + offset;
}

/// Returns the path of the scratch file `part`: `stem` followed by the part number.
std::string partPath(const std::string& stem, std::uint32_t part);

/// A scratch file that consists of one file per process (a part). A process can read bytes of another process in two
/// steps: the writer calls `handOver`, and then the reader calls `reopenOthers`. This is sufficient for network file
/// systems with close-to-open consistency. The class never asks for the size of another process's file.
class PartedScratch final : public ScratchFile {
public:
    /// Creates the scratch file of this process, with the part number `ownPart`.
    PartedScratch(std::string stem, std::uint32_t ownPart, TemporarySpace& space);

    /// Continues a scratch file that an earlier process wrote. Its first `bytes` bytes remain, and later bytes are cut
    /// off. Throws DamageError if the file is shorter or missing.
    void resume(std::uint32_t part, std::uint64_t bytes);

    void sync(std::span<const std::uint32_t> parts) override;
    void handOver() const override;
    void reopenOthers() override;

private:
    void load(std::uint64_t place, std::span<std::byte> out) const override;
    void store(std::uint64_t place, std::span<const std::byte> bytes) override;
    void forget(std::uint64_t place, std::uint64_t bytes) override;
    std::string placeText(std::uint64_t place) const override;

    std::shared_ptr<File> other(std::uint32_t part) const;

    std::string stem_;
    std::uint32_t ownPart_;
    File own_;
    mutable std::mutex mutex_;
    mutable std::map<std::uint32_t, std::shared_ptr<File>> others_; // open files of other processes, by part
};

} // namespace gnomon::scratch
