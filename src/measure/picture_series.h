// Pictures in number: along a camera path, or all around the model.
#pragma once

#include "core/progress.h"
#include "executor/executor.h"
#include "settings/settings.h"

#include <functional>
#include <optional>
#include <string>

namespace gnomon::measure {

/// Which pictures, and where they go.
struct PictureSeries {
    std::string path;          // a camera path; empty: none
    std::optional<int> frames; // of it, evenly; nothing: 60
    int turntable = 0;         // or so many all around the target; 0: none
    std::string output;        // a pattern of file names such as frame%04d.png, or "-" for YUV4MPEG2

    bool isAsked() const { return !path.empty() || turntable > 0; }
};

/// Throws UsageError for what contradicts itself.
void requireSound(const PictureSeries& series, const settings::Settings& settings);

/// What every picture of a series shows, and what takes the bytes of a stream.
struct SeriesTask {
    std::string model;
    executor::Overlay overlay = executor::Overlay::None;
    settings::Settings settings;
    std::function<void(const std::string&)> warn;
    std::function<void(const std::string& bytes)> stream;
};

/// Draws all of them. Files appear one by one, each when it is complete. Throws Error.
void drawSeries(const PictureSeries& series, const SeriesTask& task, Progress& progress);

} // namespace gnomon::measure
