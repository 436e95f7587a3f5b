// The window: user input changes the view, and each frame is drawn with an overlay.
#pragma once

#include "core/progress.h"
#include "viewer/viewer_options.h"

namespace gnomon::viewer {

/// Opens the window and returns after it is closed. Throws Error if there is no display or no OpenGL 4.5. Later errors
/// are shown in the window. `interrupt` may stop the function by an exception. The log is then complete.
void runViewer(const ViewerOptions& options, Progress& interrupt);

} // namespace gnomon::viewer
