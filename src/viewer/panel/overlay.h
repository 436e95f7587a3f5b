// What is drawn over the picture: figures and graph, panel, help, messages, wire frames.
#pragma once

#include "viewer/panel/overlay_content.h"

namespace gnomon::viewer {

/// Fills the window with `picture`, mixed with what is there, between ImGuiLayer's beginFrame and endFrame.
void drawPicture(const ShownPicture& picture);

/// Describes all that `settings` show, between ImGuiLayer's beginFrame and endFrame.
OverlayAnswer drawOverlay(const OverlayContent& content, ViewSettings& settings, StoragePad& pad);

} // namespace gnomon::viewer
