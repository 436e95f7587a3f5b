// Chooses how casters are culled from shadow maps: only by the region that each map covers, or also by the receivers in
// the image.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// Number of pixels whose receiver masks (depths of the farthest receivers) cost as much time as drawing one caster
/// triangle.
constexpr std::uint64_t kPixelsPerTriangle = 16;

/// Decides whether receivers in the image cull the casters of shadow maps, from estimated numbers of triangles and
/// pixels. Sets `plan.casterCulling`. If receivers do not cull casters, adds the reason to `plan.omitted`. The setting
/// CasterCulling::Receivers is used whenever the plan's backend draws the image before the maps.
void chooseCasterCulling(FramePlan& plan);

} // namespace gnomon::plan
