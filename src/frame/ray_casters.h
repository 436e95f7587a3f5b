// Finds the casters that rays from visible surfaces to the light can hit.
#pragma once

#include "frame/prepared_frame.h"

namespace gnomon::frame {

/// Returns the volume, in local space, that contains every ray from a visible surface to the light.
ConvexVolume rayCasterVolume(const PreparedFrame& frame);

/// Returns the level of detail that the casters of a point light require, per range of view depths [d, 2d]. Near
/// receivers thus increase only the detail of the casters that can shadow them.
std::vector<lod::CasterDetail> pointCasterDetails(const PreparedFrame& frame);

/// Returns the level of detail that all casters of a directional light require if rays compute the shadows.
lod::CasterDetail rayCasterDetail(const PreparedFrame& frame);

} // namespace gnomon::frame
