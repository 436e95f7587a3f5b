// Tests whether a frame can reuse a shadow map that the previous frame left in the depth texture.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// Returns true if pass `pass` has the same map in both plans: the same texels at the same place in the texture, for
/// the same light. A stabilised map must have the same place in the world. Any other map needs the same camera. The
/// function does not compare the casters.
bool isSameMap(const FramePlan& now, const FramePlan& before, std::size_t pass);

/// Returns true if both plans draw the same image: their views, settings and maps are equal. Maps that receivers culled
/// (CasterCulling::Receivers) are valid only for the same image.
bool isSameImage(const FramePlan& now, const FramePlan& before);

} // namespace gnomon::plan
