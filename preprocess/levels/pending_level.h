// What is left of a part of the model when its levels are built: coarse clusters that wait to be grouped with those of
// its neighbours, each as a record of its own that can go anywhere.
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

/// Where a cluster lies, and how much there is of it.
struct ClusterPlace {
    hierarchy::GridPoint center; // of its box
    std::uint32_t triangles = 0;
    std::uint32_t vertices = 0;
    std::uint32_t bytes = 0; // of its record
};

/// A pending level as bytes: the places of its clusters, a record for each of them in the same order, and the positions
/// that are borders of the part.
struct EncodedPendingLevel {
    std::vector<std::byte> bytes;
    std::uint64_t clusters = 0;
    std::uint64_t vertices = 0; // of all clusters, each by itself
    std::uint64_t triangles = 0;
};

/// The clusters of `level`, with the vertices and refinements that they use.
EncodedPendingLevel encodePendingLevel(const simplify::Mesh& mesh, const Level& level);

/// The first bytes of an encoded level of `clusters` clusters: where these lie.
constexpr std::uint64_t placeBytes(std::uint64_t clusters) {
    return clusters * sizeof(ClusterPlace);
}

/// What these bytes say.
std::vector<ClusterPlace> clusterPlaces(std::span<const std::byte> bytes);

/// Positions as bytes, and back.
std::vector<hierarchy::GridPoint> positionsFrom(std::span<const std::byte> bytes);

/// The positions of a record's vertices; those of different normals or colours repeat.
std::vector<hierarchy::GridPoint> positionsOfRecord(std::span<const std::byte> record);

/// Lets a record's refinement, where it is of level `firstLevel` + i, count its pages from `firstPages[i]`.
void countPagesFrom(std::span<std::byte> record, std::uint32_t firstLevel, std::span<const std::uint32_t> firstPages);

/// Joins clusters to one part again, welded by position.
class PendingLevelMerger {
public:
    /// For clusters of at most `vertices` vertices together, which have `fields`.
    PendingLevelMerger(
        const hierarchy::Grid& grid,
        std::size_t clusters,
        std::size_t vertices,
        const hierarchy::FieldLayout& fields = {});
    ~PendingLevelMerger();
    PendingLevelMerger(const PendingLevelMerger&) = delete;
    PendingLevelMerger& operator=(const PendingLevelMerger&) = delete;
    PendingLevelMerger(PendingLevelMerger&&) = delete;
    PendingLevelMerger& operator=(PendingLevelMerger&&) = delete;

    /// Adds whole records, one after the other.
    void add(std::span<const std::byte> records);

    /// Makes a position of the clusters so far a border.
    void lock(const hierarchy::GridPoint& position);

    PendingLevel take();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::levels
