// Pictures in number as they are asked for: along a camera path, or all around the model.
#pragma once

#include "settings/settings.h"

#include <optional>
#include <string>

namespace gnomon::settings {

/// Which pictures, and where they go.
struct PictureSeries {
    std::string path;          // a camera path; empty: none
    std::optional<int> frames; // of it, evenly; nothing: 60
    int turntable = 0;         // or so many all around the target; 0: none
    std::string output;        // a pattern of file names such as frame%04d.png, or "-" for YUV4MPEG2

    bool isAsked() const { return !path.empty() || turntable > 0; }
};

/// Throws UsageError for what contradicts itself. `isNumbered` if the output's name has a number in it.
void requireSound(const PictureSeries& series, const Settings& settings, bool isNumbered, bool hasOverlay);

/// Throws UsageError for an overlay, whose legend lies on the background, where that is transparent.
void requireLegendShown(const Settings& settings, bool hasOverlay);

} // namespace gnomon::settings
