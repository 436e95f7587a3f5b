// The window: what the hand does becomes a view, a frame is drawn of it, and what there is to say is laid over it.
#pragma once

#include "core/progress.h"
#include "settings/settings.h"

#include <optional>
#include <string>

namespace gnomon::viewer {

/// What `gnomon view` was asked for.
struct ViewerOptions {
    settings::Settings settings;
    std::string file; // a model, or a mesh to be built into the cache beside it
    int threads = 0;
    double targetMs = 0;              // 0: none
    std::string path;                 // to play from the start; empty: none
    std::optional<int> frames;        // of the path, at a fixed step; nothing: by the clock
    std::string images;               // folder for the pictures of played frames; empty: none
    std::string csv;                  // log of all frames; empty: none
    Bytes buildMemory = gibibytes(2); // peak resident size while a mesh is built
};

/// Opens the window and stays until it is closed. Throws Error where there is no display or no OpenGL 4.5; what goes
/// wrong later is told in the window. `interrupt` may stop it by an exception, which leaves the log complete.
void runViewer(const ViewerOptions& options, Progress& interrupt);

} // namespace gnomon::viewer
