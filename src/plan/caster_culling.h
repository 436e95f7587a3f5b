// Whether the maps of a planned frame draw for all that may be in their partitions, or for what the image asks for.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// Pixels of which finding out what they look up costs as much as drawing a caster triangle.
constexpr std::uint64_t kPixelsPerTriangle = 16;

/// Sets `plan.casterCulling`, with a line in `plan.omitted` where receivers do not cull; by counts alone. Where the
/// quality asks for receivers they cull whenever the plan's backend draws the image first.
void chooseCasterCulling(FramePlan& plan);

} // namespace gnomon::plan
