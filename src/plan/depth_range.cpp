#include "plan/depth_range.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace gnomon::plan {

namespace {

constexpr double kDefaultFloorRatio = 1e4; // far / near-floor
constexpr double kStepsPerOctave = 4;

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

} // namespace

double ladderStep(double depth) {
    const double step = std::floor(std::log2(depth) * kStepsPerOctave);
    const double candidate = std::exp2(step / kStepsPerOctave);
    // log2 may round up to a whole step.
    return candidate <= depth ? candidate : std::exp2((step - 1) / kStepsPerOctave);
}

namespace {

/// Near on the ladder at or below the nearest thing, its floor, or the frame before; says which unless it is the first.
void setAutomaticNear(
    DepthRange& range, const Quality& quality, const SceneFacts::Visible& visible, const FramePlan* previous) {
    const double floor = quality.nearFloor.value_or(range.far / kDefaultFloorRatio);
    range.near = ladderStep(std::max(visible.nearest, floor));
    if (visible.nearest < floor) range.nearFrom = "the floor";
    const bool wantsToRise = previous != nullptr && previous->near > 0 && range.near > previous->near &&
                             previous->framesNearIsHeld + 1 < kFramesBeforeNearRises;
    if (!wantsToRise) return;
    range.near = previous->near;
    range.nearFrom = "held from the frame before";
}

} // namespace

DepthRange depthRange(const View& view, const Quality& quality, const SceneFacts& scene, const FramePlan* previous) {
    const SceneFacts::Visible visible = scene.visible ? *scene.visible : depthsOfBounds(view, scene.bounds);
    DepthRange range;
    range.isEmpty = !visible.anything;
    const bool isGiven = quality.near && quality.far;
    if (range.isEmpty && !isGiven) {
        range = {1, 2, "nothing is in view", "nothing is in view", true};
        return range;
    }
    range.far = quality.far.value_or(visible.farthest * (1 + 1e-6));
    range.farFrom = quality.far ? "given" : (scene.visible ? "the farthest surface in view" : "the model's bounds");
    if (quality.near) {
        range.near = *quality.near;
        range.nearFrom = "given";
    } else {
        setAutomaticNear(range, quality, visible, previous);
        if (range.nearFrom.empty())
            range.nearFrom = scene.visible ? "the nearest surface in view" : "the model's bounds";
    }
    if (!(range.near > 0) || !std::isfinite(range.far))
        throw Error("--near and --far", "they must be above 0 and finite");
    if (!(range.far > range.near * (1 + 1e-6))) {
        if (quality.near && quality.far) throw Error("--far", "it must be above --near");
        // A surface that faces the eye squarely has no depth of its own.
        if (quality.far) {
            range.near = range.far / (1 + 1e-3);
        } else {
            range.far = range.near * (1 + 1e-3);
        }
    }
    return range;
}

} // namespace gnomon::plan
