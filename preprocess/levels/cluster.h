// Cutting triangles into clusters: compact ones, and small connected pieces stay whole.
#pragma once

#include "preprocess/simplify/mesh.h"

#include <glm/glm.hpp>

#include <span>

namespace gnomon::levels {

/// An order of triangles in which clusters are contiguous.
struct Clustering {
    std::vector<std::uint32_t> order;        // triangle indices
    std::vector<std::uint32_t> ends;         // where each cluster ends in `order`
    std::vector<std::uint32_t> vertexCounts; // how many vertices each cluster has
};

constexpr std::uint32_t kMaxClusterVertices = 256;

/// Cuts `triangles` (vertex indices) into clusters of at most `maxTriangles` triangles and kMaxClusterVertices
/// vertices. `positionOf` maps vertices to positions, `positions` gives their place. A connected piece of at most
/// `maxTriangles` triangles is not cut unless its vertices are too many.
Clustering clusterTriangles(
    std::span<const simplify::Triangle> triangles,
    std::span<const std::uint32_t> positionOf,
    std::span<const glm::vec3> positions,
    std::uint32_t maxTriangles);

} // namespace gnomon::levels
