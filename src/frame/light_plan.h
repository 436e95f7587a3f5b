// Plans penumbrae and sky light of a frame from its drawn clusters.
#pragma once

#include "frame/prepared_frame.h"
#include "frame/residency.h"

namespace gnomon::frame {

/// Adds penumbrae and sky light to the plan of `frame`. All pages of the frame's cut must be resident. Returns
/// immediately if the frame requests neither penumbrae nor sky light.
void planLightSampling(PreparedFrame& frame, const Residency& residency);

} // namespace gnomon::frame
