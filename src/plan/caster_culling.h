// The choice between two kinds of caster culling: by the partitions of the maps only, or also by the receivers in the
// image.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// Number of pixels for which the receiver masks cost as much time as drawing one caster triangle.
constexpr std::uint64_t kPixelsPerTriangle = 16;

/// Sets `plan.casterCulling` from estimated numbers of triangles and pixels. If receivers do not cull casters, adds the
/// reason to `plan.omitted`. The setting CasterCulling::Receivers is used whenever the plan's backend draws the image
/// before the maps.
void chooseCasterCulling(FramePlan& plan);

} // namespace gnomon::plan
