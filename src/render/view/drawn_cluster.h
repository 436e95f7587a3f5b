// The triangle ids in a visibility buffer. An id identifies a cluster of a pass and a triangle in this cluster.
#pragma once

#include "hierarchy/page.h"
#include "raster/raster.h"

namespace gnomon::render {

/// A triangle id has the index of the drawn cluster in its high bits and the index of the triangle in its low bits.
constexpr unsigned kTriangleBits = 8;
static_assert(raster::kMaxClusterTriangles == 1U << kTriangleBits);

/// A cluster of a pass, with the data that shading needs.
struct DrawnCluster {
    const hierarchy::Vertex* vertices = nullptr;
    const hierarchy::Triangle* triangles = nullptr;
    const hierarchy::Page* page = nullptr;
    std::uint32_t pageId = 0;
    std::uint32_t cluster = 0; // index in the page
    bool isGround = false;
    // true: the cluster consists of pieces of cut triangles; `triangles` then has the original triangle of each piece
    bool isPiece = false;
};

/// Returns the entry for a whole cluster of a page.
inline DrawnCluster drawnCluster(const hierarchy::Page& page, std::uint32_t id, std::uint32_t index) {
    const hierarchy::Cluster& cluster = page.clusters[index];
    return {
        page.vertices.data() + cluster.firstVertex, page.triangles.data() + cluster.firstTriangle, &page, id, index};
}

} // namespace gnomon::render
