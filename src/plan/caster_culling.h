// Whether the maps of a planned frame draw for all that may be in their partitions, or for what the image asks for.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// Pixels of which finding out what they look up costs as much as drawing a caster triangle.
constexpr std::uint64_t kPixelsPerTriangle = 16;

/// What can be done before the maps of a frame are drawn.
enum class MapOrder : std::uint8_t { MapsFirst, ImageFirst };

/// Sets `plan.casterCulling`, with a line in `plan.omitted` where receivers do not cull; by counts alone. Where the
/// quality asks for receivers they cull whenever `order` allows it.
void chooseCasterCulling(FramePlan& plan, MapOrder order);

} // namespace gnomon::plan
