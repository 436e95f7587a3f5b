// Tests whether a frame can reuse a shadow map of the previous frame that is still in the depth texture.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// Returns true if shadow pass `pass` of both plans draws the same map: the same texels at the same place in the
/// texture, for the same light. A stabilised map must have the same place in the world. Any other map needs the same
/// camera. The function does not compare the casters.
bool isSameMap(const FramePlan& now, const FramePlan& before, std::size_t pass);

/// Returns true if both plans draw the same image: their views, settings and shadow maps are equal. A map whose casters
/// were culled by receivers (CasterCulling::Receivers) is valid only for the same image.
bool isSameImage(const FramePlan& now, const FramePlan& before);

} // namespace gnomon::plan
