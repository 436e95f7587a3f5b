// The panel of what can be set with the mouse: scheme, texels, detail, overlay, light.
#pragma once

#include "viewer/panel/overlay_content.h"

namespace gnomon::viewer {

/// Describes the panel in the upper right corner, between ImGuiLayer's beginFrame and endFrame; a model must be open.
OverlayAnswer drawPanel(const OverlayContent& content, ViewSettings& settings, StoragePad& pad);

} // namespace gnomon::viewer
