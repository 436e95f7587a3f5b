// The options with which the window opens.
#pragma once

#include "settings/settings.h"
#include "settings/value_colors.h"

#include <functional>
#include <optional>
#include <string>

namespace gnomon::viewer {

/// The options of `gnomon view`.
struct ViewerOptions {
    settings::Settings settings;
    settings::ValueColors colors; // initial value; a key changes it
    std::string file;             // a model, or a mesh that is built into the cache next to it
    int threads = 0;
    double targetMs = 33;             // 0: no target
    int samples = 64;                 // frames in the mean of a resting view; 1: only the last frame
    std::string path;                 // path to play at the start; empty: none
    std::optional<int> frames;        // number of frames of the path at a fixed step; nothing: by the clock
    std::string images;               // folder for the images of played frames; empty: none
    std::string csv;                  // log of all frames; empty: none
    std::string sourceRoot;           // folder of a mesh's other files; see --source-root of a build
    Bytes buildMemory = gibibytes(2); // max resident size while a mesh is built
    std::function<void(const std::string&)> tell = [](const std::string&) {
    }; // receives notes and failures, which the window also shows
};

} // namespace gnomon::viewer
