#include "frame/light_plan.h"

#include "frame/frame_cuts.h"
#include "frame/ground.h"
#include "lod/open_sky.h"
#include "lod/penumbra_width.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace gnomon::frame {

namespace {

/// Returns an upper bound of the widths of penumbrae on the ground, in pixels. The bound assumes that the longest
/// shadow on the ground is at the smallest visible depth.
double onGround(const PreparedFrame& frame, const lod::DiscLight& light) {
    if (!frame.ground || !frame.facts.visible) return 0;
    const lod::DetailView& view = frame.rule->view();
    const double aslant = std::sqrt(1 + view.tanHalfX * view.tanHalfX + view.tanHalfY * view.tanHalfY);
    const double pixelSlope = 2 * view.tanHalfY / view.heightPixels;
    const double depth = std::max(frame.facts.visible->nearest, view.nearestDepth);
    if (!(depth > 0)) return std::numeric_limits<double>::max();
    return light.slope * aslant / (pixelSlope * depth) *
           longestShadow(*frame.ground, frame.plan.view, frame.facts.bounds);
}

lod::TiledView tiledView(const PreparedFrame& frame) {
    const plan::View& view = frame.plan.view;
    lod::TiledView seen;
    seen.tiles = {view.width, view.height};
    seen.isParallel = view.camera.isParallel();
    const double half = seen.isParallel ? halfHeightAtTarget(view.camera) : view.tanHalfY();
    seen.half = {view.aspect() * half, half};
    seen.nearest = frame.facts.visible ? frame.facts.visible->nearest : 0;
    return seen;
}

} // namespace

void planLightSampling(PreparedFrame& frame, const Residency& residency) {
    plan::FramePlan& plan = frame.plan;
    const lod::CutQuery query = cutQuery(residency, frame);
    const lod::DrawList& image = frame.cut.lists.image;
    if (plan.view.sunAngleRadians > 0) {
        const lod::DiscLight light{plan.light.unit(), 2 * std::tan(plan.view.sunAngleRadians / 2)};
        const lod::TiledView seen = tiledView(frame);
        const std::vector<double> byTile = lod::penumbraWidths(query, image, frame.cut.lists.casters, light, seen);
        plan::PenumbraBound bound{*std::max_element(byTile.begin(), byTile.end()), seen.tiles, byTile};
        bound.widest = std::max(bound.widest, onGround(frame, light));
        // The bounds per image tile include only clusters. The penumbrae on the ground and on section caps need a bound
        // for the whole image.
        if (frame.ground || !plan.view.sections.empty()) bound.byTile = {};
        plan::planPenumbra(plan, bound);
    }
    if (plan.quality.sky.directions > 0) {
        const glm::dvec3 origin = residency.query().trees->grid().origin;
        const Box bounds{frame.facts.bounds.min - origin, frame.facts.bounds.max - origin};
        const auto solids = plan.view.sections.empty() ? lod::Solids::Whole : lod::Solids::MayBeCut;
        plan::planSky(plan, frame.ground || lod::mayHideSky(query, image, bounds, solids));
    }
}

} // namespace gnomon::frame
