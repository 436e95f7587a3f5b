// The light widget: a disc over which the user drags the light. Its colours show the storage factor (texels per pixel
// that shadow maps need) of each light direction.
#pragma once

#include "frame/renderer.h"
#include "viewer/panel/texel_plot.h"

namespace gnomon::viewer {

/// Submits the light widget to Dear ImGui. `frame` provides the depth range and the shadow scheme. Returns true if the
/// user changed `towardsLight`.
bool drawLightWidget(const frame::Frame* frame, const Camera& camera, TexelPlot& plot, glm::dvec3& towardsLight);

} // namespace gnomon::viewer
