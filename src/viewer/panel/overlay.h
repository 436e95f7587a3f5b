// Draws the overlay over the image: statistics, graph, panel, help, messages and wire frames.
#pragma once

#include "viewer/panel/overlay_content.h"

namespace gnomon::viewer {

/// Fills the window with `picture`, blended with the current content. Must be called between ImGuiLayer's beginFrame
/// and endFrame.
void drawPicture(const ShownPicture& picture);

/// Describes all elements that `settings` enable. Must be called between ImGuiLayer's beginFrame and endFrame.
OverlayAnswer drawOverlay(const OverlayContent& content, ViewSettings& settings, TexelPlot& plot);

} // namespace gnomon::viewer
