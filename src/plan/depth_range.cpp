#include "plan/depth_range.h"

#include "core/error.h"
#include "shadow/quantized_near.h"

#include <algorithm>
#include <cmath>

namespace gnomon::plan {

namespace {

constexpr double kDefaultFloorRatio = 1e4; // far / near-floor

/// View depths of the part of `bounds` that lies before the eye; empty facts if none does.
SceneFacts::Visible depthsOfBounds(const View& view, const Box& bounds) {
    SceneFacts::Visible result;
    if (bounds.isEmpty()) return result;
    const CameraBasis basis = cameraBasis(view.camera);
    const glm::dvec3 half = bounds.extent() * 0.5;
    const double middle = glm::dot(basis.view, bounds.center() - view.camera.eye);
    const double reach = glm::dot(glm::abs(basis.view), half);
    result.farthest = middle + reach;
    result.nearest = std::clamp(middle - reach, 0.0, std::max(result.farthest, 0.0));
    result.anything = result.farthest > 0;
    return result;
}

/// Far is quantised as near is, from the other side: it rises at once and falls after some frames.
void setFar(DepthRange& range, const Quality& quality, double farthest, const FramePlan* previous) {
    range.far = quality.far.value_or(farthest);
    range.farFrom = "given";
    if (quality.far || !quality.stabilize || !(farthest > 0)) return;
    const bool hasPrevious = previous != nullptr && previous->quality.stabilize && previous->far > 0;
    const shadow::NearState before =
        hasPrevious ? shadow::NearState{1 / previous->far, previous->framesFarIsHeld} : shadow::NearState{};
    const shadow::NearState now = shadow::nextNear(before, 1 / farthest, 0, kFramesBeforeNearRises);
    range.far = 1 / now.near;
    range.framesFarIsHeld = now.framesAbove;
}

/// Near at the quantised step at or below the nearest thing, its floor, or the frame before; says which unless it is
/// the first.
void setNear(DepthRange& range, const Quality& quality, const SceneFacts::Visible& visible, const FramePlan* previous) {
    const double floor = quality.nearFloor.value_or(range.far / kDefaultFloorRatio);
    const shadow::NearState before =
        previous != nullptr ? shadow::NearState{previous->near, previous->framesNearIsHeld} : shadow::NearState{};
    const shadow::NearState now = shadow::nextNear(before, visible.nearest, floor, kFramesBeforeNearRises);
    range.near = now.near;
    range.framesNearIsHeld = now.framesAbove;
    if (visible.nearest < floor) range.nearFrom = "the floor";
    if (now.framesAbove > 0) range.nearFrom = "held from the frame before";
}

/// Gives a depth to what has none, such as a surface that faces the eye squarely. Throws Error for ends that are no
/// range.
void keepApart(DepthRange& range, const Quality& quality) {
    constexpr double kLeastRatio = 1 + 1e-3;
    if (!(range.near > 0) || !std::isfinite(range.far))
        throw Error("near depth and far depth", "they must be above 0 and finite");
    if (range.far > range.near * (1 + 1e-6)) return;
    if (quality.near && quality.far) throw Error("far depth", "it must be above the near one");
    if (quality.far)
        range.near = range.far / kLeastRatio;
    else
        range.far = range.near * kLeastRatio;
}

} // namespace

DepthRange depthRange(const View& view, const Quality& quality, const SceneFacts& scene, const FramePlan* previous) {
    const SceneFacts::Visible visible = scene.visible ? *scene.visible : depthsOfBounds(view, scene.bounds);
    DepthRange range;
    range.isEmpty = !visible.anything;
    const bool isGiven = quality.near && quality.far;
    if (range.isEmpty && !isGiven) {
        range = {1, 2, "nothing is in view", "nothing is in view", 0, 0, true};
        return range;
    }
    setFar(range, quality, visible.farthest * (1 + 1e-6), previous);
    if (!quality.far) range.farFrom = scene.visible ? "the farthest surface in view" : "the model's bounds";
    if (quality.near) {
        range.near = *quality.near;
        range.nearFrom = "given";
    } else {
        setNear(range, quality, visible, previous);
        if (range.nearFrom.empty())
            range.nearFrom = scene.visible ? "the nearest surface in view" : "the model's bounds";
    }
    keepApart(range, quality);
    return range;
}

} // namespace gnomon::plan
