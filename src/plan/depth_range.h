// The depth range that a frame's shadows are promised for: everything depends on its near end.
#pragma once

#include "plan/frame_plan.h"
#include "plan/plan_memory.h"

namespace gnomon::plan {

/// The range and where each end comes from.
struct DepthRange {
    DepthSpan depths; // near < far always
    DepthSpan shown;  // `depths`, and what lies before and behind them of all that is in view
    DepthSource nearFrom = DepthSource::NothingInView;
    DepthSource farFrom = DepthSource::NothingInView;
    bool isEmpty = false;              // nothing is in view, and the range is any
    std::optional<DepthMemory> memory; // for the next frame; nothing where nothing is in view, or sight is parallel
};

/// Near is the least view depth of anything drawn, not under the floor, down to a quantised step of 2^(1/4): it falls
/// at once, and rises only when the frames before have allowed that for kFramesBeforeNearRises. Far is the greatest
/// depth; stabilised slices, whose texels must keep their size, have it quantised too. What is shown beyond a given end
/// moves as near does, and begins no nearer than far/10,000. Where lines of sight are parallel both ends are those of
/// what is seen, or of the model where slices are stabilised, and shadows are shown on all of it. Throws Error for
/// given ends that are no range.
DepthRange depthRange(
    const View& view, const Quality& quality, const SceneFacts& scene, const std::optional<DepthMemory>& memory);

} // namespace gnomon::plan
