// Which shadow maps of a frame are those that the frame before left in the depth texture.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// Whether pass `pass` of `now` covers, texel by texel, the map that the same pass of `before` did: a stabilised one at
/// the same place of the world and of the texture, under the same light. Its casters are not looked at.
bool isSameMap(const FramePlan& now, const FramePlan& before, std::size_t pass);

} // namespace gnomon::plan
