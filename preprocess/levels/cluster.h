// Divides the triangles of a mesh into compact clusters. A small connected piece of the mesh is not split.
#pragma once

#include "preprocess/simplify/mesh.h"

#include <glm/glm.hpp>

#include <span>

namespace gnomon::levels {

/// An order of triangles in which the triangles of each cluster are contiguous.
struct Clustering {
    std::vector<std::uint32_t> order;        // triangle indices, cluster by cluster
    std::vector<std::uint32_t> ends;         // per cluster: the index in `order` after its last triangle
    std::vector<std::uint32_t> vertexCounts; // number of vertices per cluster
};

constexpr std::uint32_t kMaxClusterVertices = 256;

/// Divides `triangles`, which contain vertex indices, into clusters. A cluster has at most `maxTriangles` triangles and
/// at most kMaxClusterVertices vertices. `positionOf` maps vertices to positions, and `positions` contains their
/// coordinates. A connected piece of at most `maxTriangles` triangles is not split unless it has too many vertices.
Clustering clusterTriangles(
    std::span<const simplify::Triangle> triangles,
    std::span<const std::uint32_t> positionOf,
    std::span<const glm::vec3> positions,
    std::uint32_t maxTriangles);

} // namespace gnomon::levels
