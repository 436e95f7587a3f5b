// The open clusters of a part of the model. They are the clusters without groups, after the levels of the part are
// built. Later, the build groups them with clusters of neighbouring parts. Each cluster has an independent record.
#pragma once

#include "preprocess/levels/level.h"

#include <memory>
#include <span>

namespace gnomon::levels {

/// A mesh and a level of detail with its open clusters, which have no groups yet.
struct OpenClusters {
    simplify::Mesh mesh;
    Level level;
};

/// The centre of a cluster in space, and the size of its encoded record.
struct ClusterPlace {
    hierarchy::GridPoint center; // centre of the cluster's bounding box
    std::uint32_t triangles = 0;
    std::uint32_t vertices = 0;
    std::uint32_t bytes = 0; // size of the cluster's record
};

/// A list of open clusters (clusters without groups) encoded as bytes. The bytes contain the ClusterPlace of each
/// cluster, then one record per cluster in the same order, then the positions at the border of the part.
struct EncodedOpenClusters {
    std::vector<std::byte> bytes;
    std::uint64_t clusters = 0;
    std::uint64_t vertices = 0; // sum over the clusters; a vertex counts once per cluster that uses it
    std::uint64_t triangles = 0;
};

/// Encodes the clusters of `level` with their vertices and their refinements (the finer groups from which they were
/// simplified). The vertices are in `mesh`.
EncodedOpenClusters encodeOpenClusters(const simplify::Mesh& mesh, const Level& level);

/// Returns the size in bytes of `clusters` ClusterPlaces, which are at the beginning of encoded clusters.
constexpr std::uint64_t placeBytes(std::uint64_t clusters) {
    return clusters * sizeof(ClusterPlace);
}

/// Decodes a list of ClusterPlaces, the centres and record sizes of clusters.
std::vector<ClusterPlace> clusterPlaces(std::span<const std::byte> bytes);

/// Decodes a list of grid points.
std::vector<hierarchy::GridPoint> positionsFrom(std::span<const std::byte> bytes);

/// Returns the vertex positions of the cluster in `record`. A position repeats if several vertices with different
/// normals or colours are there.
std::vector<hierarchy::GridPoint> positionsOfRecord(std::span<const std::byte> record);

/// Adds an offset to the page number of the refinement in a cluster's record. The offset is `firstPages[i]` if the
/// refinement is in level `firstLevel` + i.
void countPagesFrom(std::span<std::byte> record, std::uint32_t firstLevel, std::span<const std::uint32_t> firstPages);

/// Merges the clusters of several parts of the model into one part, and welds their vertices by position.
class OpenClusterMerger {
public:
    /// Creates a merger for at most `vertices` vertices in total. Each vertex has the scalar properties `fields`.
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

    /// Adds the clusters in one or more complete records.
    void add(std::span<const std::byte> records);

    /// Marks a position as a border. Triangles of other parts use it, so it must not move.
    void lock(const hierarchy::GridPoint& position);

    /// Returns the merged clusters with their mesh.
    OpenClusters take();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::levels
