// The input for testing the casters of a frame against the samples of exact shadows, and the cost of these tests.
#pragma once

#include "exact/sample_grid.h"
#include "raster/raster.h"

#include <cstdint>
#include <span>

namespace gnomon::exact {

/// A cluster that may cast a shadow. Triangle i of the cluster has the id firstTriangleId + i. Some code calls this id
/// the name of the triangle.
struct Caster {
    raster::Cluster geometry;
    glm::i64vec3 min{0}; // min of its vertices, in cells from the frame's origin
    glm::i64vec3 max{0};
};

/// Bits of the shadow result of a sample. Each tested triangle can set bits. If kDark is set, the other bits have no
/// meaning.
constexpr std::uint8_t kLit = 0;
constexpr std::uint8_t kDark = 1;
constexpr std::uint8_t kDarkByEdge = 2; // as kDark, but the ray hits an edge, and the rule for ties assigned the hit
constexpr std::uint8_t kWithinTolerance = 4; // a triangle is ahead, but within the tolerance

/// Returns true if a triangle shadows the sample with these status bits.
inline bool isDark(std::uint8_t status) {
    return (status & (kDark | kDarkByEdge)) != 0;
}

/// The cost of testing triangles against samples. The counts depend only on samples and casters, not on threads. Only
/// `exactDecisions` also depends on the instruction set.
struct CasterCounts {
    std::uint64_t clustersTested = 0;
    std::uint64_t clustersKept = 0;        // clusters that the receiver mask of at least one map did not cull
    std::uint64_t triangles = 0;           // triangles of these clusters, counted once per map
    std::uint64_t trianglesRasterized = 0; // triangles that the receiver mask did not cull
    std::uint64_t sampleTests = 0;         // pairs of a triangle and a sample in the cells that it covers
    std::uint64_t exactDecisions = 0;      // pairs that needed integer arithmetic

    CasterCounts& operator+=(const CasterCounts& other);
};

/// The input that all threads share while they test the casters of a frame against the samples.
struct CasterContext {
    const SampleList* samples = nullptr; // with u, v and h in the grid's order
    const SampleGrid* grid = nullptr;
    /// All casters. The triangle id of a sample contains the index of the triangle's cluster in this list.
    std::span<const Caster> casters;
    glm::uvec3 originCell{0};         // grid position of the frame's origin; all cell coordinates are relative to it
    double reach = 0;                 // largest absolute coordinate of all casters, in cells from the origin
    double coordinateError = 0;       // coordinateErrorFor(reach), also used to sort `grid`
    double maxTolerance = 0;          // max tolerance over all samples, in cells along h
    std::span<std::uint8_t> statuses; // at least one per sample, in the grid's order; written without locks
};

} // namespace gnomon::exact
