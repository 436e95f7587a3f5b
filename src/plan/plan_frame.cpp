#include "plan/plan_frame.h"

#include "core/angle.h"
#include "core/formatted.h"
#include "core/limit_error.h"
#include "plan/caster_culling.h"
#include "plan/cell_maps.h"
#include "plan/depth_range.h"
#include "plan/lamp/lamp_passes.h"
#include "plan/occlusion_choice.h"
#include "plan/shadow_decision.h"
#include "plan/shadow_passes.h"
#include "shadow/caster_volume.h"

#include <algorithm>
#include <cmath>

namespace gnomon::plan {

namespace {

void requireValid(const View& view) {
    const double degrees = degreesFromRadians(view.camera.fovYRadians);
    if (view.width < 1 || view.height < 1)
        throw LimitError(
            Limit::ImageSize,
            {"image size",
             "the image has no pixels",
             "at least 1x1",
             std::to_string(view.width) + "x" + std::to_string(view.height)});
    if (!(degrees > 0 && degrees < 180))
        throw LimitError(
            Limit::FieldOfView,
            {"vertical angle", "out of range", "above 0 and below 180 degrees", std::to_string(degrees)});
    const double lightLength = glm::length(view.towardsLight);
    if (!(lightLength > 0) || !std::isfinite(lightLength))
        throw LimitError(
            Limit::LightDirection,
            {"light direction", "not a direction", "a finite length above 0", formatted("%g", lightLength)});
}

/// Returns the reason why this view needs no shadow maps, or nullopt if it needs them.
std::optional<SkipReason> reasonForNoMaps(const Quality& quality, const SceneFacts& scene, const DepthRange& range) {
    if (quality.shadows == ShadowMode::Off) return SkipReason::SwitchedOff;
    if (quality.shadows == ShadowMode::Rays) return SkipReason::RayTraced;
    if (quality.shadows == ShadowMode::Exact) return SkipReason::ResolvedExactly;
    if (range.isEmpty) return SkipReason::NothingInView;
    if (scene.light && scene.light->lit.empty()) return SkipReason::NothingFacesLight;
    if (scene.light && !scene.light->canBeShadowed) return SkipReason::NoCasterInReach;
    return std::nullopt;
}

/// Returns the reason why no visible point needs an exact shadow test, or nullopt if some points may need it.
std::optional<SkipReason> reasonForNoDecision(const SceneFacts& scene, const DepthRange& range) {
    if (range.isEmpty) return SkipReason::NothingInView;
    if (scene.isTurnedFromLight) return SkipReason::NothingFacesLight;
    return std::nullopt;
}

shadow::ViewFrustum frustumOf(const View& view, const DepthSpan& range) {
    return {range.near, range.far, view.camera.fovYRadians / 2, view.aspect()};
}

/// Removes the perspective warp and the face partitions from the settings for a parallel view. All pixels of such a
/// view have the same size, so maps without warp and without face partitions are optimal.
void unwarp(Quality& quality) {
    quality.warp.rule = shadow::WarpRule::None;
    quality.facePartitions = Choice::Off;
}

glm::dvec3 cameraLight(const View& view, const CameraBasis& basis) {
    return glm::normalize(toCamera(basis, view.light().unit()));
}

} // namespace

ConvexVolume sweptView(const View& view, const DepthSpan& range) {
    const shadow::ViewFrustum frustum = frustumOf(view, range);
    if (view.pointLight) return shadow::pointCasterVolume(shadow::corners(frustum), lampInCamera(view));
    const glm::dvec3 towardsLight = cameraLight(view, cameraBasis(view.camera));
    const shadow::PartitionSelector selector =
        shadow::partitionSelector(frustum, towardsLight, {range.near, range.far}, shadow::FaceMaps::None);
    const shadow::Region region = shadow::partitionRegion(frustum, selector, 0);
    return shadow::casterVolume(region, shadow::lightFrame(towardsLight));
}

std::optional<DepthSpan> widestRange(const View& view, const Quality& quality, const Box& bounds) {
    requireValid(view);
    if (quality.shadows != ShadowMode::Maps) return std::nullopt;
    const DepthRange range = depthRange(view, quality, {.bounds = bounds, .visible = {}, .light = {}}, {});
    if (range.isEmpty) return std::nullopt;
    return range.shown;
}

PlannedFrame planFrame(
    const View& view,
    const Quality& quality,
    const SceneFacts& scene,
    const PlanMemory& memory,
    const Capabilities& backend) {
    requireValid(view);
    PlannedFrame result;
    FramePlan& plan = result.plan;
    plan.view = view;
    plan.quality = quality;
    plan.backend = backend;
    const ShadowDecision shadows = chooseShadows(quality, backend);
    plan.quality.shadows = shadows.mode;
    plan.quality.mapsBecause.reset();
    plan.shadowReason = shadows.reason;
    if (view.camera.isParallel()) unwarp(plan.quality);
    plan.basis = cameraBasis(view.camera);
    plan.light = view.light();
    plan.towardsLight = cameraLight(view, plan.basis);
    plan.lightAngleRadians = std::atan2(std::hypot(plan.towardsLight.x, plan.towardsLight.y), plan.towardsLight.z);
    const DepthRange range = depthRange(view, quality, scene, memory.depth);
    plan.near = range.depths.near;
    plan.far = range.depths.far;
    plan.shown = range.shown;
    plan.nearFrom = range.nearFrom;
    plan.farFrom = range.farFrom;
    result.memory.depth = range.memory;
    if (const auto reason = reasonForNoMaps(plan.quality, scene, range))
        plan.omitted.push_back({Effect::ShadowMaps, *reason});
    else if (view.pointLight)
        planLampPasses(plan, scene);
    else
        result.memory.scheme = planShadowPasses(plan, scene, memory.scheme);
    if (shadows.mode == ShadowMode::Exact) {
        if (const auto reason = reasonForNoDecision(scene, range))
            plan.omitted.push_back({Effect::ExactShadows, *reason});
        else
            plan.sampleGridMaps = sampleGridMaps(plan);
    }
    chooseCasterCulling(plan);
    chooseOcclusion(plan, scene.layers);
    return result;
}

} // namespace gnomon::plan
