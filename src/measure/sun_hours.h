// Hours of sun of a model: which receivers, over which period, and what of it goes where.
#pragma once

#include "core/progress.h"
#include "daylight/sun_steps.h"
#include "settings/settings.h"

#include <functional>
#include <string>

namespace gnomon::measure {

/// An empty path is nothing.
struct SunHoursTask {
    std::string model;
    settings::Settings settings; // of the view, which is from above where they pose none; its light is not looked at
    std::function<void(const std::string&)> warn;
    settings::SunPeriod period; // what is up the model says
    std::string output;         // PNG, hours as colours
    std::string pfm;            // hours, -1 where nothing is
    std::string csv;            // a row for each receiver
    bool isResumed = false;     // go on with what a killed run left beside the first of these
};

/// What was computed, for who asked.
struct SunHoursSummary {
    std::size_t receivers = 0; // pixels that see the model
    std::size_t steps = 0;
    std::uint32_t stepsUp = 0; // in which the Sun is up
    std::uint64_t samples = 0; // that faced it, summed over those that were decided now
    std::uint64_t touching = 0;
    double errorPixels = 0; // the largest error of what was drawn
};

/// Computes and writes them; files appear when they are complete. Throws Error, UsageError for what contradicts itself,
/// and what `progress` throws: then a file beside the first output holds what was done, for a task with `isResumed`.
SunHoursSummary computeSunHours(const SunHoursTask& task, Progress& progress);

} // namespace gnomon::measure
