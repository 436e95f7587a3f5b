// The triangle ids in a visibility buffer. An id identifies a cluster of the image and a triangle in this cluster.
#pragma once

#include "hierarchy/page.h"
#include "raster/raster.h"

namespace gnomon::render {

/// Number of low bits of a triangle id, which store the index of the triangle in its cluster. The high bits store the
/// index of the drawn cluster.
constexpr unsigned kTriangleBits = 8;
static_assert(raster::kMaxClusterTriangles == 1U << kTriangleBits);

/// A drawn cluster with its vertices and triangles for shading.
struct DrawnCluster {
    const hierarchy::Vertex* vertices = nullptr;
    const hierarchy::Triangle* triangles = nullptr;
    const hierarchy::Page* page = nullptr;
    std::uint32_t pageId = 0;
    std::uint32_t cluster = 0; // index in the page
    bool isGround = false;
    // True if the cluster consists of pieces of cut triangles. `triangles` then contains the original triangle of each
    // piece.
    bool isPiece = false;
};

/// Returns the entry for a whole cluster, the cluster `index` of the page `page` with the id `id`.
inline DrawnCluster drawnCluster(const hierarchy::Page& page, std::uint32_t id, std::uint32_t index) {
    const hierarchy::Cluster& cluster = page.clusters[index];
    return {
        page.vertices.data() + cluster.firstVertex, page.triangles.data() + cluster.firstTriangle, &page, id, index};
}

} // namespace gnomon::render
