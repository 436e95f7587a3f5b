// Divides triangles into compact clusters. Small connected pieces stay in one cluster.
#pragma once

#include "preprocess/simplify/mesh.h"

#include <glm/glm.hpp>

#include <span>

namespace gnomon::levels {

/// An order of triangles with contiguous clusters.
struct Clustering {
    std::vector<std::uint32_t> order;        // triangle indices
    std::vector<std::uint32_t> ends;         // end of each cluster in `order`
    std::vector<std::uint32_t> vertexCounts; // number of vertices per cluster
};

constexpr std::uint32_t kMaxClusterVertices = 256;

/// Divides `triangles` (vertex indices) into clusters of at most `maxTriangles` triangles and kMaxClusterVertices
/// vertices. `positionOf` maps vertices to positions, and `positions` contains their coordinates. A connected piece of
/// at most `maxTriangles` triangles stays whole unless it has too many vertices.
Clustering clusterTriangles(
    std::span<const simplify::Triangle> triangles,
    std::span<const std::uint32_t> positionOf,
    std::span<const glm::vec3> positions,
    std::uint32_t maxTriangles);

} // namespace gnomon::levels
