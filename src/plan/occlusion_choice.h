// The choice of occlusion culling for the image of a plan.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// Min number of layers per pixel for which `auto` uses occlusion culling. Measured on two cores: with 1.6 layers (a
/// plant from outside), the image took 10% more time. With 3 layers or more (flights, rooms, a toy from outside), it
/// took between a fifth of the time and 1% more.
inline constexpr double kMinLayers = 2;

/// Sets `plan.skipsHidden` for a plan with its view, quality and backend. Adds the reason to `plan.omitted` if the
/// image is drawn with its hidden clusters. `layers` is the mean number of drawn clusters per pixel, by their boxes.
/// Only Choice::Auto uses it.
void chooseOcclusion(FramePlan& plan, double layers);

} // namespace gnomon::plan
