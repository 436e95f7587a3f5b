// The panel with which the user changes settings by mouse: shadow scheme, texels, detail, overlay, light.
#pragma once

#include "viewer/panel/overlay_content.h"

namespace gnomon::viewer {

/// Submits the panel in the upper right corner to Dear ImGui. A model must be open. Must be called between beginFrame
/// and endFrame of ImGuiLayer.
OverlayAnswer drawPanel(const OverlayContent& content, ViewSettings& settings, TexelPlot& plot);

} // namespace gnomon::viewer
