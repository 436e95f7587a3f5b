// Plans the shadow maps of a frame: their number, partitions and texels.
#pragma once

#include "plan/frame_plan.h"
#include "plan/plan_memory.h"

namespace gnomon::plan {

/// Sets the splits, the passes, the aliasing bound and the texture size of `plan`. The view, quality, light and depth
/// range of `plan` must be set. `before` is the memory of the previous frame. Returns the memory for the next frame.
SchemeMemory planShadowPasses(FramePlan& plan, const SceneFacts& scene, const std::optional<SchemeMemory>& before);

} // namespace gnomon::plan
