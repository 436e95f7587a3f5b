// The open clusters of a part of the model: the clusters that have no groups after the levels of the part are built. A
// later round groups them with clusters of neighbouring parts. Each cluster has an independent record.
#pragma once

#include "preprocess/levels/level.h"

#include <memory>
#include <span>

namespace gnomon::levels {

/// A mesh and the level of its open clusters.
struct OpenClusters {
    simplify::Mesh mesh;
    Level level;
};

/// The position of a cluster in space and the size of its record.
struct ClusterPlace {
    hierarchy::GridPoint center; // centre of the cluster's bounding box
    std::uint32_t triangles = 0;
    std::uint32_t vertices = 0;
    std::uint32_t bytes = 0; // size of the cluster's record
};

/// OpenClusters encoded as bytes. The bytes contain the ClusterPlace of each cluster, then one record per cluster in
/// the same order, then the positions at the border of the part.
struct EncodedOpenClusters {
    std::vector<std::byte> bytes;
    std::uint64_t clusters = 0;
    std::uint64_t vertices = 0; // sum over the clusters; a vertex counts once per cluster that uses it
    std::uint64_t triangles = 0;
};

/// Encodes the clusters of `level` with their vertices and refinements. Their vertices are in `mesh`.
EncodedOpenClusters encodeOpenClusters(const simplify::Mesh& mesh, const Level& level);

/// Returns the size in bytes of the `clusters` ClusterPlaces at the beginning of encoded clusters.
constexpr std::uint64_t placeBytes(std::uint64_t clusters) {
    return clusters * sizeof(ClusterPlace);
}

/// Decodes the ClusterPlaces in `bytes`.
std::vector<ClusterPlace> clusterPlaces(std::span<const std::byte> bytes);

/// Decodes the grid points in `bytes`.
std::vector<hierarchy::GridPoint> positionsFrom(std::span<const std::byte> bytes);

/// Returns the positions of the vertices in a record. A position repeats if several vertices with different normals or
/// colours are there.
std::vector<hierarchy::GridPoint> positionsOfRecord(std::span<const std::byte> record);

/// Adds `firstPages[i]` to the page number of the refinement in a record if the refinement is in level `firstLevel` +
/// i.
void countPagesFrom(std::span<std::byte> record, std::uint32_t firstLevel, std::span<const std::uint32_t> firstPages);

/// Merges clusters of several parts into one part and welds their vertices by position.
class OpenClusterMerger {
public:
    /// Creates a merger for at most `vertices` vertices in total. Each vertex has the given `fields`.
    OpenClusterMerger(
        const hierarchy::Grid& grid,
        std::size_t clusters,
        std::size_t vertices,
        const hierarchy::FieldLayout& fields = {});
    ~OpenClusterMerger();
    OpenClusterMerger(const OpenClusterMerger&) = delete;
    OpenClusterMerger& operator=(const OpenClusterMerger&) = delete;
    OpenClusterMerger(OpenClusterMerger&&) = delete;
    OpenClusterMerger& operator=(OpenClusterMerger&&) = delete;

    /// Adds the clusters of one or more complete records.
    void add(std::span<const std::byte> records);

    /// Marks a position of the added clusters as a border: triangles of other parts use it, so it must not move.
    void lock(const hierarchy::GridPoint& position);

    /// Returns the merged part.
    OpenClusters take();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::levels
