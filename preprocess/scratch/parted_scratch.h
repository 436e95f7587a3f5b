// The scratch files of all processes that work, or have worked, for one build: each appends to its own and reads all.
#pragma once

#include "preprocess/scratch/scratch_file.h"

#include <map>
#include <memory>
#include <mutex>

namespace gnomon::scratch {

/// A place in a PartedScratch is a part, in its upper 16 bits, and an offset in that part's file.
constexpr unsigned kPartShift = 48;

/// The most parts of one build, over all processes that ever worked for it.
constexpr std::uint32_t kMostParts = 1U << (64U - kPartShift);

/// The max size of a part.
constexpr std::uint64_t kMostPartBytes = std::uint64_t{1} << kPartShift;

constexpr std::uint32_t partOf(std::uint64_t place) {
    return static_cast<std::uint32_t>(place >> kPartShift);
}

constexpr std::uint64_t placeOf(std::uint32_t part, std::uint64_t offset) {
    return (std::uint64_t{part} << kPartShift) + offset;
}

/// The file of part `part` of those whose names begin with `stem`.
std::string partPath(const std::string& stem, std::uint32_t part);

/// What others have appended may be read once they have called `handOver` and this process `reopenOthers`: so hosts
/// that share a network file system by its rule of close-to-open agree on what is there. Sizes are never asked of it.
class PartedScratch final : public ScratchFile {
public:
    /// Makes the file of `ownPart`.
    PartedScratch(std::string stem, std::uint32_t ownPart, TemporarySpace& space);

    /// Counts the first `bytes` of a part that an earlier process left, and cuts off what it wrote after them. Throws
    /// DamageError if the file is shorter or missing.
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
    mutable std::map<std::uint32_t, std::shared_ptr<File>> others_; // that are open
};

} // namespace gnomon::scratch
