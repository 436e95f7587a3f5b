// Pictures in number: along a camera path, or all around the model.
#pragma once

#include "core/progress.h"
#include "executor/executor.h"
#include "settings/picture_series.h"
#include "settings/settings.h"

#include <functional>
#include <optional>
#include <string>

namespace gnomon::measure {

/// What every picture of a series shows, and what takes the bytes of a stream.
struct SeriesTask {
    std::string model;
    executor::Overlay overlay = executor::Overlay::None;
    settings::Settings settings;
    std::function<void(const std::string&)> warn;
    std::function<void(const std::string& bytes)> stream;
    std::optional<int> samples; // frames that each picture is the mean of; nothing: the usual number
};

/// Draws all of them. Files appear one by one, each when it is complete. Throws Error, and
/// UsageError for what contradicts itself.
void drawSeries(const settings::PictureSeries& series, const SeriesTask& task, Progress& progress);

} // namespace gnomon::measure
