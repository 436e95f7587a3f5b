// Which shadow maps of a frame are those that the frame before left in the depth texture.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// Whether pass `pass` of `now` covers, texel by texel, the map that the same pass of `before` did, at the same place
/// of the texture and under the same light: a stabilised one at the same place of the world, another from the same
/// camera. Its casters are not looked at.
bool isSameMap(const FramePlan& now, const FramePlan& before, std::size_t pass);

/// Whether both plans draw one image: the view, every setting and every map are equal. Maps that receivers culled
/// (CasterCulling::Receivers) are valid for no other image.
bool isSameImage(const FramePlan& now, const FramePlan& before);

} // namespace gnomon::plan
