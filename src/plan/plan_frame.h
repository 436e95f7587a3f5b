// Plans a frame. The input is a view, settings, scene facts and the hysteresis values of the previous frame. The result
// is the plan, and the hysteresis values for the next frame. Planning is a pure function without GL, files or a clock.
#pragma once

#include "plan/frame_plan.h"
#include "plan/plan_memory.h"

namespace gnomon::plan {

/// Returns the volume, in camera space, of all casters that can throw a shadow onto a visible point whose depth is in
/// `range`.
ConvexVolume sweptView(const View& view, const DepthSpan& range);

/// Returns a depth range that contains every depth range that planFrame can choose for `view`. The function does not
/// need the scene facts. Returns nullopt if the plan draws no shadow maps. `quality.shadows` must not be Auto.
std::optional<DepthSpan> widestRange(const View& view, const Quality& quality, const Box& bounds);

/// The plan of a frame, and the hysteresis values for the plan of the next frame.
struct PlannedFrame {
    FramePlan plan;
    PlanMemory memory;
};

/// Returns the plan that describes the passes and shadow maps of a frame of `view` with `quality`. `memory` contains
/// the hysteresis values of the previous frame. `backend` has the capabilities of the backend that draws the plan.
/// Throws Error if the view or a given depth range is invalid.
PlannedFrame planFrame(
    const View& view,
    const Quality& quality,
    const SceneFacts& scene,
    const PlanMemory& memory = {},
    const Capabilities& backend = {});

} // namespace gnomon::plan
