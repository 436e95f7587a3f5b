// The window: user input becomes a view, a frame is drawn of it, and what there is to say is laid over it.
#pragma once

#include "core/progress.h"
#include "viewer/viewer_options.h"

namespace gnomon::viewer {

/// Opens the window and stays until it is closed. Throws Error where there is no display or no OpenGL 4.5; what goes
/// wrong later is told in the window. `interrupt` may stop it by an exception, which leaves the log complete.
void runViewer(const ViewerOptions& options, Progress& interrupt);

} // namespace gnomon::viewer
