// The shared input of all clusters that a frame rasterises into the sample grid, and the counts of this work.
#pragma once

#include "exact/sample_grid.h"
#include "raster/raster.h"

#include <cstdint>
#include <span>

namespace gnomon::exact {

/// A cluster that may lie between samples and the light. Triangle i has the name firstTriangleId + i.
struct Caster {
    raster::Cluster geometry;
    glm::i64vec3 min{0}; // min of its vertices, in cells from the frame's origin
    glm::i64vec3 max{0};
};

/// The status of a sample after the rasterisation of clusters: bits that accumulate. If kDark is set, the other bits
/// have no meaning.
constexpr std::uint8_t kLit = 0;
constexpr std::uint8_t kDark = 1;       // a triangle is ahead, farther than the tolerance
constexpr std::uint8_t kDarkByEdge = 2; // the same, but the ray hits an edge and the rule for ties assigned the hit
constexpr std::uint8_t kWithinTolerance = 4; // a triangle is ahead, but within the tolerance

/// Returns true if the light does not reach a sample.
inline bool isDark(std::uint8_t status) {
    return (status & (kDark | kDarkByEdge)) != 0;
}

/// The cost of the rasterisation into the sample grid. The counts depend only on samples and casters, not on threads.
/// `exactDecisions` also depends on the instruction set.
struct CasterCounts {
    std::uint64_t clustersTested = 0;
    std::uint64_t clustersKept = 0;        // clusters that the mask of a map did not skip
    std::uint64_t triangles = 0;           // triangles of these clusters, once per map
    std::uint64_t trianglesRasterized = 0; // triangles that the mask did not skip
    std::uint64_t sampleTests = 0;         // pairs of a triangle and a sample in its cells
    std::uint64_t exactDecisions = 0;      // pairs that doubles could not resolve

    CasterCounts& operator+=(const CasterCounts& other);
};

/// The shared input of all clusters that a frame rasterises into the sample grid.
struct CasterContext {
    const SampleList* samples = nullptr; // with u, v and h in the grid's order
    const SampleGrid* grid = nullptr;
    /// Clusters with the triangles of samples have the index that the triangle names contain.
    std::span<const Caster> casters;
    glm::uvec3 originCell{0};         // subtracted from each position
    double reach = 0;                 // largest absolute coordinate of all casters, in cells from the origin
    double coordinateError = 0;       // coordinateErrorFor(reach), also used to sort `grid`
    double maxTolerance = 0;          // max over all samples, in cells along h
    std::span<std::uint8_t> statuses; // at least one per sample, in the grid's order; written without locks
};

} // namespace gnomon::exact
