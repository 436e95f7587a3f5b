// What all clusters of a frame are cast over, and what comes of it.
#pragma once

#include "exact/sample_grid.h"
#include "raster/raster.h"

#include <cstdint>
#include <span>

namespace gnomon::exact {

/// A cluster that may stand between the samples and the light. The name of triangle i is firstTriangleId + i.
struct Caster {
    raster::Cluster geometry;
    glm::i64vec3 least{0}; // of its vertices, cells from the frame's origin
    glm::i64vec3 most{0};
};

/// What is known of a sample once casters went over it; bits that add up, but with kDark the others mean nothing.
constexpr std::uint8_t kLit = 0;
constexpr std::uint8_t kDark = 1;       // a triangle is ahead, farther than the tolerance
constexpr std::uint8_t kDarkByEdge = 2; // the same, but the ray meets just its edge, and the rule for ties decided
constexpr std::uint8_t kTouched = 4;    // a triangle is ahead, but not farther than the tolerance

/// Whether the light does not reach a sample.
inline bool isDark(std::uint8_t status) {
    return (status & (kDark | kDarkByEdge)) != 0;
}

/// What casting took. Depends on samples and casters alone, not on threads; `exactDecisions` on the instruction set
/// too.
struct CastCounts {
    std::uint64_t clustersTested = 0;
    std::uint64_t clustersKept = 0;   // by the mask of some map
    std::uint64_t triangles = 0;      // of clusters that the mask kept, once a map
    std::uint64_t trianglesCast = 0;  // that the mask kept
    std::uint64_t sampleTests = 0;    // pairs of a triangle and a sample in the cells that it was cast over
    std::uint64_t exactDecisions = 0; // of those whose verdict doubles left open

    CastCounts& operator+=(const CastCounts& other);
};

/// What all clusters of a frame are cast over.
struct CastContext {
    const SampleList* samples = nullptr; // their u, v and h in the grid's order
    const SampleGrid* grid = nullptr;
    std::span<const Caster> casters;  // those that hold samples' triangles stand where the names say
    glm::uvec3 originCell{0};         // subtracted from each position
    double reach = 0;                 // the largest coordinate of all casters, cells from the origin
    double coordinateError = 0;       // coordinateErrorFor that, as `grid` was sorted with
    double mostTolerance = 0;         // of all samples, cells along h
    std::span<std::uint8_t> statuses; // by the grid's order of samples, at least; written without a lock
};

} // namespace gnomon::exact
