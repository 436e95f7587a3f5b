// Draws the user interface over the image: statistics, graph, panel, help, messages and wire frames.
#pragma once

#include "viewer/panel/overlay_content.h"

namespace gnomon::viewer {

/// Fills the window with `picture`, blended over its current content. Must be called between beginFrame and endFrame of
/// ImGuiLayer.
void drawPicture(const ShownPicture& picture);

/// Submits to Dear ImGui all user interface elements that `settings` enable, and returns the user's response. Must be
/// called between beginFrame and endFrame of ImGuiLayer.
OverlayAnswer drawOverlay(const OverlayContent& content, ViewSettings& settings, TexelPlot& plot);

} // namespace gnomon::viewer
