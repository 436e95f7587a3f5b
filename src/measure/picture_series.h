// Drawing of a series of pictures, along a camera path or on a turntable around the model.
#pragma once

#include "core/progress.h"
#include "executor/executor.h"
#include "settings/picture_series.h"
#include "settings/settings.h"

#include <functional>
#include <optional>
#include <string>

namespace gnomon::measure {

/// The model and the settings that all pictures of a series share.
struct SeriesTask {
    std::string model;
    executor::Overlay overlay = executor::Overlay::None;
    settings::Settings settings;
    std::function<void(const std::string&)> warn;         // receives warnings, one line each
    std::function<void(const std::string& bytes)> stream; // receives the bytes of a YUV4MPEG2 stream
    std::optional<int> samples; // number of frames that are averaged per picture; nullopt: the default
};

/// Draws all pictures of a series. Each file appears when it is complete. Throws Error, and UsageError for options that
/// contradict each other.
void drawSeries(const settings::PictureSeries& series, const SeriesTask& task, Progress& progress);

} // namespace gnomon::measure
