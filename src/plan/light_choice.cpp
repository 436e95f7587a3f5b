#include "plan/frame_plan.h"
#include "plan/light_directions.h"
#include "plan/light_sampling.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace gnomon::plan {

namespace {

/// Returns the reason why the image cannot show penumbrae and sky light, or nullopt if it can show them.
std::optional<SkipReason> reasonForNoSoftness(const Quality& quality) {
    if (hasNoSun(quality.look.shading)) return SkipReason::NoSun;
    if (quality.shadows == ShadowMode::Off) return SkipReason::NoShadows;
    return std::nullopt;
}

/// Returns the mask of the image tiles whose penumbrae can be at least `minWidth` pixels wide. Returns null if the mask
/// would contain all tiles of the image.
std::shared_ptr<const shadow::TileMask> softTiles(const PenumbraBound& bound, double minWidth) {
    shadow::TileMask mask{bound.tiles, {}};
    for (const double width : bound.byTile)
        mask.wanted.push_back(!(width < minWidth));
    if (mask.count() == mask.wanted.size()) return nullptr;
    return std::make_shared<const shadow::TileMask>(std::move(mask));
}

} // namespace

void planPenumbra(FramePlan& plan, const PenumbraBound& bound) {
    plan.penumbra = {};
    if (!(plan.view.sunAngleRadians > 0)) return;
    if (const auto reason = reasonForNoSoftness(plan.quality)) {
        plan.omitted.push_back({Effect::Penumbra, *reason});
        return;
    }
    plan.penumbra.widestPixels = bound.widest;
    plan.penumbra.minPixels = minPenumbra(plan.quality.lightError);
    if (bound.widest < plan.penumbra.minPixels) {
        SkippedEffect skipped{Effect::Penumbra, SkipReason::NarrowPenumbrae};
        skipped.pixels = plan.penumbra.minPixels;
        plan.omitted.push_back(skipped);
        return;
    }
    plan.penumbra.directions = directionsFor(plan.quality.lightError);
    plan.penumbra.tiles = softTiles(bound, plan.penumbra.minPixels);
}

void planSky(FramePlan& plan, bool isAnythingHidden) {
    plan.sky = {};
    if (plan.quality.sky.directions == 0) return;
    if (const auto reason = reasonForNoSoftness(plan.quality)) {
        plan.omitted.push_back({Effect::SkyLight, *reason});
    } else if (!isAnythingHidden) {
        plan.omitted.push_back({Effect::SkyLight, SkipReason::NothingHidesTheSky});
    } else {
        plan.sky = plan.quality.sky;
    }
}

void skipLightSampling(FramePlan& plan) {
    if (plan.penumbra.directions > 1) plan.omitted.push_back({Effect::Penumbra, SkipReason::NoSun});
    if (plan.sky.directions > 0) plan.omitted.push_back({Effect::SkyLight, SkipReason::NoSun});
    plan.penumbra.directions = 1;
    plan.penumbra.tiles.reset();
    plan.sky = {};
}

int lightFrames(const FramePlan& plan) {
    return std::max(plan.penumbra.directions, plan.sky.directions);
}

} // namespace gnomon::plan
