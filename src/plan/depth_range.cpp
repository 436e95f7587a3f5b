#include "plan/depth_range.h"

#include "core/limit_error.h"
#include "plan/distant_view.h"
#include "plan/hysteresis.h"

#include <algorithm>
#include <cmath>

namespace gnomon::plan {

namespace {

constexpr double kDefaultFloorRatio = 1e4; // default ratio of the far depth to the smallest permitted near depth

/// Returns the range of view depths of the part of `bounds` in front of the eye. If no part is in front of the eye, the
/// result has `anything` = false.
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

/// Sets the far end of `range`. For stabilised slices, far is rounded to steps like near, but in the opposite
/// direction: far rises at once, and falls only after several frames.
void setFar(
    DepthRange& range, const Quality& quality, double farthest, const std::optional<shadow::NearState>& inverseBefore) {
    range.depths.far = quality.far.value_or(farthest);
    shadow::NearState inverse{0, 0};
    if (!quality.far && quality.stabilize && farthest > 0) {
        inverse =
            shadow::nextNear(inverseBefore.value_or(shadow::NearState{}), 1 / farthest, 0, kFramesBeforeNearRises);
        range.depths.far = 1 / inverse.near;
    }
    if (quality.stabilize) range.memory->inverseFar = inverse;
}

/// Sets the near end of `range` to the highest step (power of 2^(1/4)) at or below the depth of the nearest surface.
/// Near is at least the permitted minimum, and the hysteresis can keep near at the value of the previous frame.
void setNear(
    DepthRange& range,
    const Quality& quality,
    const SceneFacts::Visible& visible,
    const std::optional<DepthMemory>& memory) {
    const double floor = quality.nearFloor.value_or(range.depths.far / kDefaultFloorRatio);
    const shadow::NearState before = memory ? memory->near : shadow::NearState{};
    range.memory->near = shadow::nextNear(before, visible.nearest, floor, kFramesBeforeNearRises);
    range.depths.near = range.memory->near.near;
    if (visible.nearest < floor) range.nearFrom = DepthSource::Floor;
    if (range.memory->near.framesAbove > 0) range.nearFrom = DepthSource::Held;
}

/// Widens a depth range whose ends are equal, so that far / near is kMinRatio. The ends are equal if a surface
/// perpendicular to the view direction is the only visible surface. Throws Error if the given ends are not a valid
/// range.
void separate(DepthSpan& depths, const Quality& quality) {
    constexpr double kMinRatio = 1 + 1e-3;
    if (!(depths.near > 0) || !std::isfinite(depths.far))
        throw LimitError(
            {Limit::NearDepth, Limit::FarDepth},
            {"near depth and far depth",
             "invalid range",
             "near above 0 and far finite",
             std::to_string(depths.near) + " to " + std::to_string(depths.far)});
    if (depths.far > depths.near * (1 + 1e-6)) return;
    if (quality.near && quality.far)
        throw LimitError(
            Limit::FarDepth,
            {"far depth",
             "it must be greater than the near depth",
             "above " + std::to_string(depths.near),
             std::to_string(depths.far)});
    if (quality.far)
        depths.near = depths.far / kMinRatio;
    else
        depths.far = depths.near * kMinRatio;
}

/// Returns the near end of DepthRange::shown. The result is `end`, unless the nearest visible `depth` is smaller. Then
/// the result is a power of 2^(1/4) at or below `depth`, but not below `floor`. `state` stores the hysteresis. The
/// function also computes the far end: all depths and the result are then inverse depths.
double shownEnd(double end, double depth, double floor, std::optional<shadow::NearState>& state) {
    const bool exceedsEnd = depth < end && floor < end;
    if (!exceedsEnd && !state) return end;
    state = shadow::nextNear(
        state.value_or(shadow::NearState{}),
        exceedsEnd ? depth : end,
        exceedsEnd ? floor : end,
        kFramesBeforeNearRises);
    if (state->near < end) return state->near;
    state.reset();
    return end;
}

/// Sets `range.shown`, which is the range `range.depths` extended to all visible surfaces.
void setShown(DepthRange& range, const SceneFacts::Visible& visible, const std::optional<DepthMemory>& memory) {
    DepthMemory& now = *range.memory;
    if (memory) now.shownNear = memory->shownNear;
    if (memory) now.inverseShownFar = memory->inverseShownFar;
    const double inverseFar = shownEnd(1 / range.depths.far, 1 / visible.farthest, 0, now.inverseShownFar);
    range.shown.far = now.inverseShownFar ? 1 / inverseFar : range.depths.far;
    range.shown.near =
        shownEnd(range.depths.near, visible.nearest, range.shown.far / kDefaultFloorRatio, now.shownNear);
}

/// Sets the depth range of a parallel view to the visible depths. Shadow aliasing does not depend on depth in such a
/// view, so the range needs no hysteresis. With stabilised slices, the range contains all depths of the model instead,
/// so that the texels preserve their size.
void setParallelRange(DepthRange& range, const View& view, const Quality& quality, const SceneFacts::Visible& visible) {
    constexpr double kMinRatio = 1 + 1e-5;
    const double nearest = glm::length(view.camera.target - view.camera.eye); // depth of the near end of the model
    const double near = quality.stabilize ? nearest : visible.nearest * (1 - 1e-9);
    const double far = quality.stabilize ? nearest * kDistantGrowth : visible.farthest * (1 + 1e-9);
    range.depths.near = quality.near.value_or(std::min(near, quality.far.value_or(far) / kMinRatio));
    range.depths.far = quality.far.value_or(std::max(far, range.depths.near * kMinRatio));
    if (quality.near) range.nearFrom = DepthSource::Given;
    separate(range.depths, quality);
    range.shown = {std::min(range.depths.near, near), std::max(range.depths.far, far)};
    range.memory.reset();
}

} // namespace

DepthRange depthRange(
    const View& view, const Quality& quality, const SceneFacts& scene, const std::optional<DepthMemory>& memory) {
    const SceneFacts::Visible visible = scene.visible ? *scene.visible : depthsOfBounds(view, scene.bounds);
    DepthRange range;
    range.isEmpty = !visible.anything;
    if (range.isEmpty && !(quality.near && quality.far)) {
        range.depths = range.shown = {1, 2};
        return range;
    }
    DepthMemory now;
    range.memory = now;
    setFar(range, quality, visible.farthest * (1 + 1e-6), memory ? memory->inverseFar : std::nullopt);
    range.nearFrom = scene.visible ? DepthSource::NearestSurface : DepthSource::ModelBounds;
    range.farFrom = scene.visible ? DepthSource::FarthestSurface : DepthSource::ModelBounds;
    if (quality.far) range.farFrom = DepthSource::Given;
    if (view.camera.isParallel()) {
        setParallelRange(range, view, quality, visible);
        return range;
    }
    if (quality.near) {
        range.depths.near = *quality.near;
        range.nearFrom = DepthSource::Given;
    } else {
        setNear(range, quality, visible, memory);
    }
    separate(range.depths, quality);
    range.memory->near.near = range.depths.near;
    if (range.memory->inverseFar) range.memory->inverseFar->near = 1 / range.depths.far;
    range.shown = range.depths;
    if (range.isEmpty)
        range.memory.reset();
    else
        setShown(range, visible, memory);
    return range;
}

} // namespace gnomon::plan
