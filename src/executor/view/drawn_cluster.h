// What a pixel of the visibility buffer names: a triangle of a cluster of a pass.
#pragma once

#include "hierarchy/page.h"
#include "raster/raster.h"

namespace gnomon::executor {

/// A triangle's name in the visibility buffer: the drawn cluster's place above, the triangle's place in it below.
constexpr unsigned kTriangleBits = 8;
static_assert(raster::kMaxClusterTriangles == 1U << kTriangleBits);

/// A cluster of a pass, as shading wants it.
struct DrawnCluster {
    const hierarchy::Vertex* vertices = nullptr;
    const hierarchy::Triangle* triangles = nullptr;
    const hierarchy::Page* page = nullptr;
    std::uint32_t pageId = 0;
    std::uint32_t cluster = 0; // in the page
    bool isGround = false;
    bool isPiece = false; // triangles are those of the cluster that pieces of them are drawn for, one a piece
};

/// A cluster of a page, whole.
inline DrawnCluster drawnCluster(const hierarchy::Page& page, std::uint32_t id, std::uint32_t index) {
    const hierarchy::Cluster& cluster = page.clusters[index];
    return {
        page.vertices.data() + cluster.firstVertex, page.triangles.data() + cluster.firstTriangle, &page, id, index};
}

} // namespace gnomon::executor
