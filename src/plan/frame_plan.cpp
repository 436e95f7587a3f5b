#include "plan/frame_plan.h"

#include "core/error.h"
#include "plan/depth_range.h"
#include "plan/shadow_passes.h"

#include <algorithm>
#include <cmath>

namespace gnomon::plan {

namespace {

void requireValid(const View& view) {
    const double degrees = view.camera.fovYRadians * 180 / 3.14159265358979323846;
    if (view.width < 1 || view.height < 1)
        throw Error(
            "--size",
            "an image has pixels",
            "at least 1x1",
            std::to_string(view.width) + "x" + std::to_string(view.height));
    if (!(degrees > 0 && degrees < 180))
        throw Error(
            "--fov-y", "the vertical angle is impossible", "above 0 and below 180 degrees", std::to_string(degrees));
    if (!(glm::length(view.towardsLight) > 0) || !std::isfinite(glm::length(view.towardsLight)))
        throw Error("--light", "this is no direction");
}

} // namespace

FramePlan planFrame(const View& view, const Quality& quality, const SceneFacts& scene, const FramePlan* previous) {
    requireValid(view);
    FramePlan plan;
    plan.view = view;
    plan.quality = quality;
    plan.basis = cameraBasis(view.camera);
    plan.towardsLight = glm::normalize(toCamera(plan.basis, glm::normalize(view.towardsLight)));
    plan.lightAngleRadians = std::atan2(std::hypot(plan.towardsLight.x, plan.towardsLight.y), plan.towardsLight.z);
    const DepthRange range = depthRange(view, quality, scene, previous);
    plan.near = range.near;
    plan.far = range.far;
    plan.nearFrom = range.nearFrom;
    plan.farFrom = range.farFrom;
    const bool isHeld = previous != nullptr && !quality.near && plan.nearFrom.starts_with("held");
    plan.framesNearIsHeld = isHeld ? previous->framesNearIsHeld + 1 : 0;
    if (quality.shadows == ShadowMode::Off) {
        plan.omitted.push_back({"shadows", "switched off"});
    } else if (range.isEmpty) {
        plan.omitted.push_back({"shadow maps", "nothing is in view"});
    } else if (quality.shadows == ShadowMode::Rays) {
        plan.omitted.push_back({"shadow maps", "shadows are ray-traced"});
    } else {
        planShadowPasses(plan, previous);
        plan.promiseKept = std::max(plan.promised.x, plan.promised.z) <= quality.maxAliasing || quality.zPartitions;
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
    const bool isWarped =
        std::any_of(plan.passes.begin(), plan.passes.end(), [](const ShadowPass& pass) { return pass.warp.kappa > 0; });
    return isWarped ? name + "+w" : name;
}

std::string warpName(const shadow::Warp& warp) {
    using shadow::WarpRule;
    switch (warp.rule) {
    case WarpRule::None:
        return "none";
    case WarpRule::Psm:
        return "psm";
    case WarpRule::Lspsm:
        return "lspsm";
    case WarpRule::Tsm:
        return "tsm";
    case WarpRule::Minimax:
        return "minimax";
    case WarpRule::Auto:
        return "auto";
    case WarpRule::LeastStorage:
        return "sopt";
    case WarpRule::Eta:
        return "eta";
    case WarpRule::Given:
        return "given";
    }
    return "";
}

} // namespace gnomon::plan
