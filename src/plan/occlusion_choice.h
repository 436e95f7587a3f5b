// Whether an image is drawn without what it hides.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// With fewer layers over a pixel than this, `auto` finds too little hidden to look for it. Measured, two cores: at 1.6
/// (a plant from outside) the image took 10% more time; from 3 on (flights, rooms, a toy from outside) at most 1% more
/// and down to a fifth.
inline constexpr double kLeastLayers = 2;

/// Says in `plan`, one of planFrame's, whether its image is drawn without what is hidden, and why not if not; `layers`
/// is how many drawn clusters lie over a pixel on average, by their boxes, and counts where `auto` decides.
void chooseOcclusion(FramePlan& plan, double layers);

} // namespace gnomon::plan
