// The panel for settings with the mouse: scheme, texels, detail, overlay, light.
#pragma once

#include "viewer/panel/overlay_content.h"

namespace gnomon::viewer {

/// Describes the panel in the upper right corner. Must be called between ImGuiLayer's beginFrame and endFrame, with an
/// open model.
OverlayAnswer drawPanel(const OverlayContent& content, ViewSettings& settings, TexelPlot& plot);

} // namespace gnomon::viewer
