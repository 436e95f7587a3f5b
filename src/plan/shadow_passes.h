// Plans the shadow maps of a frame: their number, partitions and texels.
#pragma once

#include "plan/frame_plan.h"
#include "plan/plan_memory.h"

namespace gnomon::plan {

/// Plans the shadow maps of `plan`: sets its splits, passes, aliasing bound and texture size. The view, quality, light
/// and depth range of `plan` must be set. `before` has the hysteresis values of the previous frame. Returns the
/// hysteresis values for the next frame.
SchemeMemory planShadowPasses(FramePlan& plan, const SceneFacts& scene, const std::optional<SchemeMemory>& before);

} // namespace gnomon::plan
