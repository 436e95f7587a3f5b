#include "plan/frame_plan.h"

#include "core/angle.h"
#include "core/error.h"
#include "plan/depth_range.h"
#include "plan/shadow_passes.h"
#include "shadow/caster_volume.h"

#include <algorithm>
#include <cmath>

namespace gnomon::plan {

namespace {

void requireValid(const View& view) {
    const double degrees = degreesFromRadians(view.camera.fovYRadians);
    if (view.width < 1 || view.height < 1)
        throw Error(
            "image size",
            "an image has pixels",
            "at least 1x1",
            std::to_string(view.width) + "x" + std::to_string(view.height));
    if (!(degrees > 0 && degrees < 180))
        throw Error(
            "vertical angle", "this angle is impossible", "above 0 and below 180 degrees", std::to_string(degrees));
    const double lightLength = glm::length(view.towardsLight);
    if (!(lightLength > 0) || !std::isfinite(lightLength))
        throw Error("light direction", "this is no direction", "a finite length above 0", std::to_string(lightLength));
}

/// Why this view calls for no map at all; empty if it does.
std::string reasonForNoMaps(const Quality& quality, const SceneFacts& scene, const DepthRange& range) {
    if (quality.shadows == ShadowMode::Off) return "switched off";
    if (quality.shadows == ShadowMode::Rays) return "shadows are ray-traced";
    if (range.isEmpty) return "nothing is in view";
    if (scene.light && scene.light->lit.empty()) return "no visible surface faces the light";
    if (scene.light && !scene.light->canBeShadowed) return "no caster can reach a visible surface";
    return "";
}

shadow::ViewFrustum frustumOf(const View& view, const DepthSpan& range) {
    return {range.near, range.far, view.camera.fovYRadians / 2, view.aspect()};
}

glm::dvec3 cameraLight(const View& view, const CameraBasis& basis) {
    return glm::normalize(toCamera(basis, glm::normalize(view.towardsLight)));
}

} // namespace

ConvexVolume sweptView(const View& view, const DepthSpan& range) {
    const shadow::ViewFrustum frustum = frustumOf(view, range);
    const glm::dvec3 towardsLight = cameraLight(view, cameraBasis(view.camera));
    const shadow::PartitionSelector selector =
        shadow::partitionSelector(frustum, towardsLight, {range.near, range.far}, shadow::FaceMaps::None);
    const shadow::Region region = shadow::partitionRegion(frustum, selector, 0);
    return shadow::casterVolume(region, shadow::lightFrame(towardsLight));
}

std::optional<DepthSpan> widestRange(const View& view, const Quality& quality, const Box& bounds) {
    requireValid(view);
    if (quality.shadows != ShadowMode::Maps) return std::nullopt;
    const DepthRange range = depthRange(view, quality, {.bounds = bounds, .visible = {}, .light = {}}, nullptr);
    if (range.isEmpty) return std::nullopt;
    return DepthSpan{range.near, range.far};
}

FramePlan planFrame(const View& view, const Quality& quality, const SceneFacts& scene, const FramePlan* previous) {
    requireValid(view);
    FramePlan plan;
    plan.view = view;
    plan.quality = quality;
    plan.basis = cameraBasis(view.camera);
    plan.towardsLight = cameraLight(view, plan.basis);
    plan.lightAngleRadians = std::atan2(std::hypot(plan.towardsLight.x, plan.towardsLight.y), plan.towardsLight.z);
    const DepthRange range =
        depthRange(view, quality, scene, previous != nullptr && previous->seesNothing ? nullptr : previous);
    plan.near = range.near;
    plan.far = range.far;
    plan.nearFrom = range.nearFrom;
    plan.farFrom = range.farFrom;
    plan.seesNothing = range.isEmpty;
    plan.framesNearIsHeld = range.framesNearIsHeld;
    plan.framesFarIsHeld = range.framesFarIsHeld;
    const std::string reason = reasonForNoMaps(quality, scene, range);
    if (reason.empty()) {
        planShadowPasses(plan, scene, previous);
    } else {
        plan.omitted.push_back({"shadow maps", reason});
    }
    return plan;
}

std::string schemeName(const FramePlan& plan) {
    if (plan.quality.shadows == ShadowMode::Off) return "off";
    if (plan.quality.shadows == ShadowMode::Rays) return "rays";
    if (plan.passes.empty()) return "none";
    const std::size_t slices = plan.splits.size() - 1;
    std::string name;
    if (plan.hasFaces) name = slices > 1 ? "fp+" : "fp";
    if (slices > 1) name += "zp" + std::to_string(slices);
    if (name.empty()) name = "map";
    const bool isWarped = std::any_of(
        plan.passes.begin(), plan.passes.end(), [](const ShadowPass& pass) { return pass.map.warped.kappa > 0; });
    return isWarped ? name + "+w" : name;
}

} // namespace gnomon::plan
