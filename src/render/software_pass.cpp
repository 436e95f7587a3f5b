#include "render/software_pass.h"

#include "render/frame_block.h"
#include "render/view/section_memory.h"

namespace gnomon::render {

void SoftwarePass::gather(const DrawInputs& frame, const lod::DrawList& list, Cutting cutting) {
    clusters_.clear();
    drawn_.clear();
    hasGround_ = false;
    const bool isCut = cutting == Cutting::BySections && !frame.plan->view.sections.empty();
    if (isCut) frame.sectionMemory->cut.cut(frame, list.ranges);
    for (const lod::ClusterRange& range : list.ranges) {
        if (isCut) {
            addCut(frame, range);
            continue;
        }
        const hierarchy::Page& page = frame.pages(range.page);
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c)
            addWhole(drawnCluster(page, range.page, c));
    }
}

void SoftwarePass::addCut(const DrawInputs& frame, const lod::ClusterRange& range) {
    SectionCut& cut = frame.sectionMemory->cut;
    const hierarchy::Page& page = frame.pages(range.page);
    for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
        const Containment place = cut.place(page.clusters[c].box);
        if (place == Containment::Inside) addWhole(drawnCluster(page, range.page, c));
        if (place == Containment::Intersecting) cut.addPieces(drawnCluster(page, range.page, c), clusters_, drawn_);
    }
}

void SoftwarePass::addWhole(const DrawnCluster& drawn) {
    const hierarchy::Cluster& cluster = drawn.page->clusters[drawn.cluster];
    clusters_.push_back(
        {&drawn.vertices->position.x,
         sizeof(hierarchy::Vertex),
         cluster.vertexCount,
         {drawn.triangles, cluster.triangleCount},
         static_cast<std::uint32_t>(drawn_.size()) << kTriangleBits});
    drawn_.push_back(drawn);
}

void SoftwarePass::addGround(const hierarchy::Page& ground) {
    const auto name = static_cast<std::uint32_t>(drawn_.size()) << kTriangleBits;
    clusters_.push_back(
        {&ground.vertices.front().position.x,
         sizeof(hierarchy::Vertex),
         static_cast<std::uint32_t>(ground.vertices.size()),
         ground.triangles,
         name});
    drawn_.push_back({ground.vertices.data(), ground.triangles.data(), &ground, hierarchy::kNone, 0, true, false});
    hasGround_ = true;
}

std::span<const raster::CellBox> SoftwarePass::boxes() {
    boxes_.clear();
    for (const DrawnCluster& drawn : drawn_) {
        const auto& [min, max] = drawn.page->clusters[drawn.cluster].box;
        boxes_.push_back({{min.x, min.y, min.z}, {max.x, max.y, max.z}});
    }
    return boxes_;
}

raster::View rasterView(
    const CameraRelativeSpace& space, const glm::dmat4& clipFromDraw, const raster::PixelBox& viewport) {
    raster::View view;
    view.eyeCell = glm::ivec3(space.originCell.x, space.originCell.y, space.originCell.z);
    view.clipFromCell = glm::mat4(clipFromDraw);
    for (int axis = 0; axis < 3; ++axis)
        view.clipFromCell[axis] *= static_cast<float>(space.step); // exact, because the step is a power of two
    view.viewport = viewport;
    return view;
}

MapView::MapView(const DrawInputs& frame, const shadow::ShadowMap& map) {
    const shadow::TexelRectangle& r = map.rectangle;
    const MapDrawing drawing = mapDrawing(frame, map);
    view = rasterView(drawing.space, drawing.clipFromDraw(), {r.x, r.y, r.x + r.width, r.y + r.height});
    rows = shadow::rowPositions(drawing.image, r.y, r.height);
    view.rowPositions = rows;
}

} // namespace gnomon::render
