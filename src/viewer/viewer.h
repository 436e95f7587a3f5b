// The window of `gnomon view`. User input changes the view, and each frame is drawn with a user interface over it.
#pragma once

#include "core/progress.h"
#include "viewer/viewer_options.h"

namespace gnomon::viewer {

/// Opens the window and returns after it is closed. Throws Error if there is no display or no OpenGL 4.5. Later errors
/// are shown in the window. If `interrupt` throws an exception, the function ends with it, and the log is complete.
void runViewer(const ViewerOptions& options, Progress& interrupt);

} // namespace gnomon::viewer
