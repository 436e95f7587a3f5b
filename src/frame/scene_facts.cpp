#include "frame/scene_facts.h"

#include "lod/frame_cut.h"
#include "lod/lit_side.h"
#include "lod/visible_depths.h"
#include "plan/distant_view.h"
#include "plan/plan_frame.h"

#include <algorithm>

namespace gnomon::frame {

namespace {

/// Returns the receivers and the casters of the view at depths in `seen`.
plan::SceneFacts::Light lightFacts(
    const plan::View& view, const lod::CutQuery& query, const lod::Cut& cut, const DepthSpan& seen) {
    const lod::DetailView& detail = query.rule->view();
    const ConvexVolume swept = lod::localVolume(plan::sweptView(view, seen), detail);
    plan::SceneFacts::Light light;
    Box casters;
    for (const lod::CasterBlock& block : lod::casterBlocks(query, cut.lists.casters[0])) {
        if (classify(swept, block.box) == Containment::Outside) continue;
        casters.add(block.box);
        light.casters.push_back({{block.box.min - detail.eye, block.box.max - detail.eye}, block.triangles});
    }
    light.seen = lod::visibleSlabs(query, cut.lists.image, seen);
    // which surfaces face the light is computed only for directional lights, so all visible depths count as lit
    if (view.pointLight) {
        light.lit = {seen};
        return light;
    }
    const lod::LitSurfaces surfaces = lod::litSurfaces(query, cut.lists.image, view.light().unit(), casters, seen);
    light.lit = surfaces.spans;
    light.canBeShadowed = surfaces.canBeShadowed;
    return light;
}

} // namespace

lod::DetailView detailView(const plan::View& view, const glm::dvec3& eye) {
    lod::DetailView detail;
    detail.eye = eye;
    detail.basis = cameraBasis(view.camera);
    detail.tanHalfX = view.tanHalfX();
    detail.tanHalfY = view.tanHalfY();
    // In a distant view, a pixel at the far end of the model is kDistantGrowth times as large as requested. The larger
    // pixel count compensates for this, so that no pixel has more error than requested.
    detail.heightPixels = view.camera.isParallel() ? view.height * plan::kDistantGrowth : view.height;
    return detail;
}

plan::SceneFacts sceneFacts(
    const plan::View& view,
    const Box& bounds,
    const lod::CutQuery& query,
    const lod::Cut& cut,
    const std::optional<DepthSpan>& range,
    std::vector<lod::DepthCandidate>& scratch) {
    plan::SceneFacts facts;
    facts.bounds = bounds;
    facts.visible = plan::SceneFacts::Visible();
    const std::optional<lod::VisibleDepths> seen = lod::visibleDepthRange(query, cut.lists.image, scratch);
    if (!seen || !(seen->span.far > 0)) return facts;
    facts.visible = {seen->span.near, seen->span.far, true};
    // `range` begins at the smallest permitted near depth. Smaller view depths are clamped to it.
    if (range)
        facts.light = lightFacts(
            view, query, cut, {std::max(seen->span.near, range->near), std::max(seen->span.far, range->near)});
    return facts;
}

bool isTurnedFromLight(const plan::View& view, const lod::CutQuery& query, const lod::Cut& cut) {
    if (view.pointLight) return false; // this is computed only for directional lights
    return !lod::mayFaceLight(query, cut.lists.image, view.light().unit());
}

} // namespace gnomon::frame
