// The casters that rays from visible surfaces to the light can hit.
#pragma once

#include "frame/prepared_frame.h"

namespace gnomon::frame {

/// Returns the volume, in local space, that contains every ray from a visible surface to the light.
ConvexVolume rayCasterVolume(const PreparedFrame& frame);

/// Returns the required detail of the casters of a point light. Each entry belongs to a range of view depths with far =
/// 2 near. Near receivers thus increase only the detail of the casters that can shadow them.
std::vector<lod::CasterDetail> pointCasterDetails(const PreparedFrame& frame);

/// Returns the required detail of all casters that rays can hit, for a directional light.
lod::CasterDetail rayCasterDetail(const PreparedFrame& frame);

} // namespace gnomon::frame
