// What the window is asked for when it opens.
#pragma once

#include "settings/settings.h"
#include "settings/value_colors.h"

#include <functional>
#include <optional>
#include <string>

namespace gnomon::viewer {

/// What `gnomon view` was asked for.
struct ViewerOptions {
    settings::Settings settings;
    settings::ValueColors colors; // at the start; by a key later
    std::string file;             // a model, or a mesh to be built into the cache beside it
    int threads = 0;
    double targetMs = 33;             // 0: none
    int samples = 64;                 // frames that the picture of a standing view is the mean of; 1: the last alone
    std::string path;                 // to play from the start; empty: none
    std::optional<int> frames;        // of the path, at a fixed step; nothing: by the clock
    std::string images;               // folder for the pictures of played frames; empty: none
    std::string csv;                  // log of all frames; empty: none
    std::string sourceRoot;           // of a mesh's other files, as --source-root of a build
    Bytes buildMemory = gibibytes(2); // peak resident size while a mesh is built
    std::function<void(const std::string&)> tell = [](const std::string&) {
    }; // what is noted, and what has failed, beside being shown
};

} // namespace gnomon::viewer
