#include "executor/software_pass.h"

namespace gnomon::executor {

void SoftwarePass::gather(const FrameDrawing& frame, const selection::DrawList& list) {
    clusters_.clear();
    drawn_.clear();
    for (const selection::ClusterRange& range : list.ranges) {
        const hierarchy::Page& page = frame.pages(range.page);
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            const hierarchy::Cluster& cluster = page.clusters[c];
            const hierarchy::Vertex* vertices = page.vertices.data() + cluster.firstVertex;
            const hierarchy::Triangle* triangles = page.triangles.data() + cluster.firstTriangle;
            clusters_.push_back(
                {&vertices->position.x,
                 sizeof(hierarchy::Vertex),
                 cluster.vertexCount,
                 {triangles, cluster.triangleCount},
                 static_cast<std::uint32_t>(drawn_.size()) << kTriangleBits});
            drawn_.push_back({vertices, triangles, &page, range.page, c});
        }
    }
}

std::span<const raster::CellBox> SoftwarePass::boxes() {
    boxes_.clear();
    for (const DrawnCluster& drawn : drawn_) {
        const auto& [min, max] = drawn.page->clusters[drawn.cluster].box;
        boxes_.push_back({{min.x, min.y, min.z}, {max.x, max.y, max.z}});
    }
    return boxes_;
}

raster::View rasterView(const DrawSpace& space, const glm::dmat4& clipFromDraw, const raster::PixelBox& viewport) {
    raster::View view;
    view.eyeCell = glm::ivec3(space.originCell.x, space.originCell.y, space.originCell.z);
    view.clipFromCell = glm::mat4(clipFromDraw);
    for (int axis = 0; axis < 3; ++axis)
        view.clipFromCell[axis] *= static_cast<float>(space.step); // a power of two: exact
    view.viewport = viewport;
    return view;
}

} // namespace gnomon::executor
