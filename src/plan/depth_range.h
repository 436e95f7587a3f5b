// The depth range that a frame's shadows are promised for: everything depends on its near end.
#pragma once

#include "plan/frame_plan.h"

#include <string>

namespace gnomon::plan {

/// The range with a word on where each end comes from. near < far always; `isEmpty` if nothing is in view.
struct DepthRange {
    double near = 0;
    double far = 0;
    std::string nearFrom;
    std::string farFrom;
    int framesNearIsHeld = 0; // at its quantised step
    int framesFarIsHeld = 0;
    bool isEmpty = false;
};

/// The least view depth of anything drawn, not under the floor, down to a quantised step of 2^(1/4): it falls at
/// once, and rises only when `previous` has wanted that for kFramesBeforeNearRises frames. Far is the greatest;
/// stabilised slices, whose texels must keep their size, have it quantised too.
DepthRange depthRange(const View& view, const Quality& quality, const SceneFacts& scene, const FramePlan* previous);

/// How long near must want to rise, or far to fall, before it does.
constexpr int kFramesBeforeNearRises = 12;

} // namespace gnomon::plan
