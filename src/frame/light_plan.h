// What a frame's plan says of penumbrae and of the sky, from what is drawn in it.
#pragma once

#include "frame/prepared_frame.h"
#include "frame/residency.h"

namespace gnomon::frame {

/// Completes the plan of `frame`, which is cut and whose pages are resident. Costs nothing where neither is asked for.
void planLightSampling(PreparedFrame& frame, const Residency& residency);

} // namespace gnomon::frame
