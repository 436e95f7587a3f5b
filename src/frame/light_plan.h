// The planning of penumbrae and sky light, based on the drawn clusters of a frame.
#pragma once

#include "frame/prepared_frame.h"
#include "frame/residency.h"

namespace gnomon::frame {

/// Completes the plan of `frame`, whose cut must be complete and resident. Returns immediately if the frame requests
/// neither penumbrae nor sky light.
void planLightSampling(PreparedFrame& frame, const Residency& residency);

} // namespace gnomon::frame
