// The choice between two kinds of caster culling: by partition only, or also by the receivers in the image.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// Number of pixels whose receiver mask costs as much to compute as drawing one caster triangle.
constexpr std::uint64_t kPixelsPerTriangle = 16;

/// Sets `plan.casterCulling` from estimated counts of triangles and pixels. Adds an entry to `plan.omitted` if
/// receivers do not cull casters. CasterCulling::Receivers in the quality is used whenever the plan's backend draws the
/// image first.
void chooseCasterCulling(FramePlan& plan);

} // namespace gnomon::plan
