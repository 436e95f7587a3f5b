// Planning a frame: from a view, a quality, what is known of the scene and the memory of the frame before, to a plan
// and the memory for the next. A pure function: no GL, files or clock.
#pragma once

#include "plan/frame_plan.h"
#include "plan/plan_memory.h"

namespace gnomon::plan {

/// All of space (camera space) that can throw a shadow onto something seen between the depths of `range`.
ConvexVolume sweptView(const View& view, const DepthSpan& range);

/// The depths that the plan of `view` will lie within, before the hierarchy was asked; nothing if it draws no maps.
/// `quality.shadows` is not Auto.
std::optional<DepthSpan> widestRange(const View& view, const Quality& quality, const Box& bounds);

/// A plan, and what the plan of the next frame is to be told.
struct PlannedFrame {
    FramePlan plan;
    PlanMemory memory;
};

/// The plan for `view` with `quality`; `memory`, that of the frame before, steadies what must not jump from frame to
/// frame; `backend` is what will carry it out. Throws Error if the view is impossible.
PlannedFrame planFrame(
    const View& view,
    const Quality& quality,
    const SceneFacts& scene,
    const PlanMemory& memory = {},
    const Capabilities& backend = {});

} // namespace gnomon::plan
