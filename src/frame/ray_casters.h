// The casters that rays from the visible surfaces to the light can hit: one volume for the whole frustum.
#pragma once

#include "frame/prepared_frame.h"

namespace gnomon::frame {

/// Returns the volume, in local space, that contains every ray from a visible surface to the light.
ConvexVolume rayCasterVolume(const PreparedFrame& frame);

/// Returns the required detail of the casters of a point light. There is one entry per range of view depths with a
/// ratio of 2. Near receivers thus increase only the detail of casters that shadow them.
std::vector<lod::CasterDetail> pointCasterDetails(const PreparedFrame& frame);

/// Returns the required detail of all casters that rays can hit, for a directional light.
lod::CasterDetail rayCasterDetail(const PreparedFrame& frame);

} // namespace gnomon::frame
