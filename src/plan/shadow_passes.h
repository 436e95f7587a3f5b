// The shadow maps of a frame: how many, of what, with which texels.
#pragma once

#include "plan/frame_plan.h"
#include "plan/plan_memory.h"

namespace gnomon::plan {

/// Fills the splits, passes, promise and texture of `plan`, whose view, quality, light and depth range are set;
/// `before` is the memory of the frame before, and that of this one is returned.
SchemeMemory planShadowPasses(FramePlan& plan, const SceneFacts& scene, const std::optional<SchemeMemory>& before);

} // namespace gnomon::plan
