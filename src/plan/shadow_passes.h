// The shadow maps of a frame: how many, of what, with which texels.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// Fills the splits, passes, promise and texture of `plan`, whose view, quality, light and depth range are set.
void planShadowPasses(FramePlan& plan, const SceneFacts& scene, const FramePlan* previous);

} // namespace gnomon::plan
