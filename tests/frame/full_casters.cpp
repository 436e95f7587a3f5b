#include "tests/frame/full_casters.h"

#include "frame/renderer.h"
#include "frame/scene_facts.h"
#include "lod/caster_detail.h"
#include "lod/frame_cut.h"
#include "render/software_backend.h"

namespace gnomon::tests {

namespace {

using lod::ClusterRange;
using lod::DrawList;
using render::DrawInputs;

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
    bool withinTolerance,
    const hierarchy::Grid& grid,
    hierarchy::ResidentPages pages) {
    DrawList result;
    for (const ClusterRange& range : list.ranges)
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            const hierarchy::Cluster& cluster = pages[range.page]->clusters[c];
            if ((classify(pyramid, grid.local(cluster.box)) != Containment::Outside) != withinTolerance) continue;
            result.ranges.push_back({range.page, c, 1});
            ++result.clusters;
            result.triangles += cluster.triangleCount;
        }
    return result;
}

/// Every caster of the plan's maps at full detail, by pass.
lod::Cut fullCasters(const frame::Frame& frame, const hierarchy::ModelFile& model, const AllPages& pages) {
    const plan::View& view = frame.plan.view;
    const hierarchy::Grid& grid = model.summary().grid;
    const lod::DetailView detail = frame::detailView(view, view.camera.eye - grid.origin);
    std::vector<ConvexVolume> volumes;
    std::vector<lod::CasterDetail> casters;
    for (const plan::ShadowPass& pass : frame.plan.passes) {
        casters.push_back(lod::casterDetail(detail, pass.map));
        casters.back().texel = {}; // however small an error is, it counts
        volumes.push_back(casters.back().casters);
    }
    const lod::PageTrees trees(model.pages(), grid);
    const lod::ErrorRule rule(detail, casters);
    lod::CutQuery query;
    query.trees = &trees;
    query.resident = pages.table();
    query.rule = &rule;
    query.errorPixels = 0;
    query.volumes = volumes;
    return lod::cutFrame(query);
}

} // namespace

CasterDifference casterDifference(
    const hierarchy::ModelFile& model, const plan::View& view, const plan::Quality& quality) {
    const std::unique_ptr<render::Backend> backend = render::makeSoftwareBackend();
    const frame::Frame frame =
        frame::Renderer(model, *backend, {.memory = gibibytes(4), .onDamaged = {}}).render(view, quality, {});
    const AllPages pages(model);
    const hierarchy::Grid& grid = model.summary().grid;
    render::DrawInputs drawing;
    drawing.plan = &frame.plan;
    drawing.space = frame.space;
    drawing.grid = grid;
    drawing.image = &frame.cut.lists.image;
    drawing.pages = [&](std::uint32_t page) -> const hierarchy::Page& { return *pages.table()[page]; };
    drawing.clipNear = 1e-3 * grid.step();
    for (std::size_t p = 0; p < frame.plan.passes.size(); ++p)
        drawing.casters.push_back(&frame.cut.lists.casters[p]);
    backend->draw(drawing);
    const render::Picture planned = backend->picture();

    CasterDifference result;
    const lod::Cut full = fullCasters(frame, model, pages);
    const ConvexVolume pyramid = lod::viewPyramid(frame::detailView(view, view.camera.eye - grid.origin));
    std::vector<DrawList> lists;
    for (std::size_t p = 0; p < frame.plan.passes.size(); ++p) {
        DrawList& list = lists.emplace_back(part(*drawing.casters[p], pyramid, true, grid, pages.table()));
        const DrawList offScreen = part(*full.lists.all()[p], pyramid, false, grid, pages.table());
        list.ranges.insert(list.ranges.end(), offScreen.ranges.begin(), offScreen.ranges.end());
        result.offScreenTriangles += drawing.casters[p]->triangles - list.triangles;
        result.fullOffScreenTriangles += offScreen.triangles;
    }
    for (std::size_t p = 0; p < lists.size(); ++p)
        drawing.casters[p] = &lists[p];
    backend->draw(drawing);
    result.wrongFraction = render::difference(planned, backend->picture()).changedFraction;
    return result;
}

} // namespace gnomon::tests
