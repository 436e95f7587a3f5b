#include "frame/full_casters.h"

#include "culling/caster_detail.h"
#include "culling/frame_cut.h"
#include "executor/software_executor.h"
#include "frame/renderer.h"
#include "frame/scene_facts.h"

namespace gnomon::tests {

namespace {

using executor::FrameDrawing;
using selection::ClusterRange;
using selection::DrawList;

/// All pages of a model, in memory.
class AllPages {
public:
    explicit AllPages(const hierarchy::ModelFile& model) {
        for (std::uint32_t page = 0; page < model.pages().size(); ++page)
            pages_.push_back(std::make_unique<const hierarchy::Page>(model.readPage(page)));
        for (const auto& page : pages_)
            table_.push_back(page.get());
    }

    hierarchy::ResidentPages table() const { return table_; }

private:
    std::vector<std::unique_ptr<const hierarchy::Page>> pages_;
    std::vector<const hierarchy::Page*> table_;
};

/// The clusters of `list` that touch `pyramid`, or those that do not.
DrawList part(
    const DrawList& list,
    const ConvexVolume& pyramid,
    bool touching,
    const hierarchy::Grid& grid,
    hierarchy::ResidentPages pages) {
    DrawList result;
    for (const ClusterRange& range : list.ranges)
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            const hierarchy::Cluster& cluster = pages[range.page]->clusters[c];
            if ((classify(pyramid, grid.local(cluster.box)) != Containment::Outside) != touching) continue;
            result.ranges.push_back({range.page, c, 1});
            ++result.clusters;
            result.triangles += cluster.triangleCount;
        }
    return result;
}

/// Every caster of the plan's maps at full detail, by pass.
selection::Cut fullCasters(const frame::Frame& frame, const hierarchy::ModelFile& model, const AllPages& pages) {
    const plan::View& view = frame.plan.view;
    const hierarchy::Grid& grid = model.summary().grid;
    const selection::DetailView detail = frame::detailView(view, view.camera.eye - grid.origin);
    std::vector<ConvexVolume> volumes;
    std::vector<selection::CasterDetail> casters;
    for (const plan::ShadowPass& pass : frame.plan.passes) {
        casters.push_back(culling::casterDetail(detail, pass.map));
        casters.back().texel = {}; // however small an error is, it counts
        volumes.push_back(casters.back().casters);
    }
    const selection::PageTrees trees(model.pages(), grid);
    const selection::ErrorRule rule(detail, casters);
    selection::CutQuery query;
    query.trees = &trees;
    query.resident = pages.table();
    query.rule = &rule;
    query.errorPixels = 0;
    query.volumes = volumes;
    return culling::cutFrame(query);
}

} // namespace

CasterDifference casterDifference(
    const hierarchy::ModelFile& model, const plan::View& view, const plan::Quality& quality) {
    const std::unique_ptr<executor::Executor> executor = executor::makeSoftwareExecutor();
    const frame::Frame frame =
        frame::Renderer(model, *executor, {.memory = gibibytes(4), .onDamaged = {}}).render(view, quality, {});
    const AllPages pages(model);
    const hierarchy::Grid& grid = model.summary().grid;
    executor::FrameDrawing drawing;
    drawing.plan = &frame.plan;
    drawing.space = frame.space;
    drawing.grid = grid;
    drawing.image = &frame.cut.lists[0];
    drawing.pages = [&](std::uint32_t page) -> const hierarchy::Page& { return *pages.table()[page]; };
    drawing.clipNear = 1e-3 * grid.step();
    for (std::size_t p = 0; p < frame.plan.passes.size(); ++p)
        drawing.casters.push_back(&frame.cut.lists[p + 1]);
    executor->draw(drawing);
    const executor::Picture planned = executor->picture();

    CasterDifference result;
    const selection::Cut full = fullCasters(frame, model, pages);
    const ConvexVolume pyramid = selection::viewPyramid(frame::detailView(view, view.camera.eye - grid.origin));
    std::vector<DrawList> lists;
    for (std::size_t p = 0; p < frame.plan.passes.size(); ++p) {
        DrawList& list = lists.emplace_back(part(*drawing.casters[p], pyramid, true, grid, pages.table()));
        const DrawList offScreen = part(full.lists[p], pyramid, false, grid, pages.table());
        list.ranges.insert(list.ranges.end(), offScreen.ranges.begin(), offScreen.ranges.end());
        result.offScreenTriangles += drawing.casters[p]->triangles - list.triangles;
        result.fullOffScreenTriangles += offScreen.triangles;
    }
    for (std::size_t p = 0; p < lists.size(); ++p)
        drawing.casters[p] = &lists[p];
    executor->draw(drawing);
    result.wrongFraction = executor::difference(planned, executor->picture()).changedFraction;
    return result;
}

} // namespace gnomon::tests
