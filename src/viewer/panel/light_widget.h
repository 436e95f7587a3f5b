// The light widget: the user drags the light over a hemisphere that is coloured by the storage factor of each
// direction.
#pragma once

#include "frame/renderer.h"
#include "viewer/panel/texel_plot.h"

namespace gnomon::viewer {

/// Describes the widget for Dear ImGui. `frame` provides the depth range and the scheme. Returns true if the user
/// changed `towardsLight`.
bool drawLightWidget(const frame::Frame* frame, const Camera& camera, TexelPlot& plot, glm::dvec3& towardsLight);

} // namespace gnomon::viewer
