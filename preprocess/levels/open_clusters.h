// The open clusters of a part of the model after its levels are built. They wait to be grouped with clusters of
// neighbouring parts. Each cluster has an independent record.
#pragma once

#include "preprocess/levels/level.h"

#include <memory>
#include <span>

namespace gnomon::levels {

/// A mesh with the open clusters of its coarsest level.
struct OpenClusters {
    simplify::Mesh mesh;
    Level level;
};

/// The place and the size of a cluster.
struct ClusterPlace {
    hierarchy::GridPoint center; // centre of its box
    std::uint32_t triangles = 0;
    std::uint32_t vertices = 0;
    std::uint32_t bytes = 0; // size of its record
};

/// OpenClusters in bytes: first the ClusterPlace of each cluster, then one record per cluster in the same order, then
/// the border positions of the part of the model.
struct EncodedOpenClusters {
    std::vector<std::byte> bytes;
    std::uint64_t clusters = 0;
    std::uint64_t vertices = 0; // sum over the clusters; shared vertices count repeatedly
    std::uint64_t triangles = 0;
};

/// Encodes the clusters of `level` with their vertices and refinements.
EncodedOpenClusters encodeOpenClusters(const simplify::Mesh& mesh, const Level& level);

/// Returns the size of the places at the beginning of an encoded level with `clusters` clusters.
constexpr std::uint64_t placeBytes(std::uint64_t clusters) {
    return clusters * sizeof(ClusterPlace);
}

/// Decodes the places.
std::vector<ClusterPlace> clusterPlaces(std::span<const std::byte> bytes);

/// Decodes positions.
std::vector<hierarchy::GridPoint> positionsFrom(std::span<const std::byte> bytes);

/// Returns the positions of a record's vertices. Positions repeat if a vertex has several normals or colours.
std::vector<hierarchy::GridPoint> positionsOfRecord(std::span<const std::byte> record);

/// Adds `firstPages[i]` to the page number of a record's refinement if the refinement is in level `firstLevel` + i.
void countPagesFrom(std::span<std::byte> record, std::uint32_t firstLevel, std::span<const std::uint32_t> firstPages);

/// Merges clusters into one part again and welds them by position.
class OpenClusterMerger {
public:
    /// Creates a merger for at most `vertices` vertices in total, with these `fields`.
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

    /// Adds one or more complete records.
    void add(std::span<const std::byte> records);

    /// Marks a position of the added clusters as a border.
    void lock(const hierarchy::GridPoint& position);

    /// Returns the merged part.
    OpenClusters take();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::levels
