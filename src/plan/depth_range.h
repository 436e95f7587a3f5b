// Computes the range of view depths in which a frame's shadow aliasing has an upper bound. The near end of the range
// has the largest influence on the aliasing.
#pragma once

#include "plan/frame_plan.h"
#include "plan/plan_memory.h"

namespace gnomon::plan {

/// The depth range of a frame in which shadow aliasing has an upper bound, and the reason for each end.
struct DepthRange {
    DepthSpan depths; // near < far
    DepthSpan shown;  // `depths`, extended to the nearest and farthest visible depth
    DepthSource nearFrom = DepthSource::NothingInView;
    DepthSource farFrom = DepthSource::NothingInView;
    bool isEmpty = false; // true: no surface is in view, and the range is arbitrary
    // hysteresis values for the next frame; empty if no surface is in view or the projection is parallel
    std::optional<DepthMemory> memory;
};

/// Returns the depth range of a frame in which its shadow aliasing has an upper bound.
///
/// For a perspective view, near is the smallest view depth of a drawn surface, rounded down to a step of 2^(1/4). Near
/// is at least `quality.nearFloor`. If a surface comes nearer, near falls at once. Near rises only after
/// kFramesBeforeNearRises consecutive frames that permit a higher step. Far is the largest view depth. With stabilised
/// slices, far is also rounded to a step, so that the texels preserve their size. If `quality` gives near or far,
/// visible surfaces can lie outside the range, and `shown` extends to these surfaces. The ends of `shown` have the same
/// hysteresis as near. The near end of `shown` is at least its far end / 10,000.
///
/// For a parallel view, the range contains the visible surfaces. With stabilised slices, it contains the whole model.
/// All visible surfaces show shadows.
///
/// Throws Error if the given ends are not a valid range.
DepthRange depthRange(
    const View& view, const Quality& quality, const SceneFacts& scene, const std::optional<DepthMemory>& memory);

} // namespace gnomon::plan
