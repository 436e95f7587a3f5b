// Decides whether an image is drawn with occlusion culling.
#pragma once

#include "plan/frame_plan.h"

namespace gnomon::plan {

/// Min mean number of overlapping clusters per pixel from which Choice::Auto uses occlusion culling. Measured on two
/// cores: with 1.6 clusters per pixel (a plant from outside), the image took 10% more time than without culling. With 3
/// or more (flights, rooms, a toy from outside), it took between 20% and 101% of the time without culling.
inline constexpr double kMinLayers = 2;

/// Decides whether the image skips hidden clusters, and sets `plan.skipsHidden`. `plan` must have its view, quality and
/// backend. If hidden clusters are drawn, adds the reason to `plan.omitted`. `layers` is the mean number of clusters
/// that overlap at a pixel, estimated from their boxes. Only Choice::Auto uses `layers`.
void chooseOcclusion(FramePlan& plan, double layers);

} // namespace gnomon::plan
