// Plans how many light directions a frame needs for penumbrae and sky light.
#pragma once

#include "frame/prepared_frame.h"
#include "frame/residency.h"

namespace gnomon::frame {

/// Adds penumbrae and sky light to the plan of `frame`. All model pages with drawn clusters of the frame must be in
/// memory. Returns immediately if the settings request neither penumbrae nor sky light.
void planLightSampling(PreparedFrame& frame, const Residency& residency);

} // namespace gnomon::frame
