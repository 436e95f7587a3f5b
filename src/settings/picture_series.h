// The options of a series of pictures, along a camera path or on a turntable around the model.
#pragma once

#include "settings/settings.h"

#include <optional>
#include <string>

namespace gnomon::settings {

/// The options for the cameras and the output of a series.
struct PictureSeries {
    std::string path;          // file of a camera path; empty: no path
    std::optional<int> frames; // number of pictures at even times along the path; nullopt: 60
    int turntable = 0;         // number of pictures in a full turn around the target; 0: no turntable
    std::string output;        // pattern of file names such as frame%04d.png, or "-" for a YUV4MPEG2 stream

    bool isAsked() const { return !path.empty() || turntable > 0; }
};

/// Throws UsageError if options contradict each other. `isNumbered` is true if the name of the output contains a number
/// pattern.
void requireSound(const PictureSeries& series, const Settings& settings, bool isNumbered, bool hasOverlay);

/// Throws UsageError for an overlay with a transparent background, because the legend is drawn on the background.
void requireLegendShown(const Settings& settings, bool hasOverlay);

} // namespace gnomon::settings
