// What is left of a part of the model when its levels are built: coarse clusters that wait to be grouped with those of
// its neighbours.
#pragma once

#include "preprocess/levels/level.h"

#include <memory>
#include <span>

namespace gnomon::levels {

/// A mesh and the clusters of its coarsest level, not in groups.
struct PendingLevel {
    simplify::Mesh mesh;
    Level level;
};

/// A pending level as bytes, and how much they hold.
struct EncodedPendingLevel {
    std::vector<std::byte> bytes;
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
};

/// The triangles of `level`, with the vertices and refinements that they use.
EncodedPendingLevel encodePendingLevel(const simplify::Mesh& mesh, const Level& level);

/// Joins the pending levels of neighbouring parts, so that positions which only they share are borders no longer.
class PendingLevelMerger {
public:
    /// For parts of at most `vertices` vertices together.
    PendingLevelMerger(const hierarchy::Grid& grid, std::size_t vertices);
    ~PendingLevelMerger();
    PendingLevelMerger(const PendingLevelMerger&) = delete;
    PendingLevelMerger& operator=(const PendingLevelMerger&) = delete;
    PendingLevelMerger(PendingLevelMerger&&) = delete;
    PendingLevelMerger& operator=(PendingLevelMerger&&) = delete;

    /// Adds the next part; its refinements of level `firstLevel` + i count their pages from `firstPages[i]`.
    void add(std::span<const std::byte> bytes, std::uint32_t firstLevel, std::span<const std::uint32_t> firstPages);

    PendingLevel take();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::levels
