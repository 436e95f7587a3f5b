// Hours of sun of a model: which receivers, over which period, and what of it goes where.
#pragma once

#include "measure/sun_hours_team.h"
#include "settings/sun_period.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace gnomon::measure {

/// An empty path is nothing. Receivers are the pixels of a view; or, in a uniform cut, the points of a file or all of
/// its vertices.
struct SunHoursTask {
    SunHoursTeam* team = nullptr; // the processes that decide
    std::string model;
    settings::Settings settings; // of the view, which is from above where they pose none; its light is not looked at
    std::function<void(const std::string&)> warn;
    settings::SunPeriod period;  // what is up the model says
    std::string points;          // a CSV, read
    bool isOfVertices = false;   // else of these, if there is one, else of a view
    std::optional<double> error; // of the cut, world units; nothing: the finest level
    std::string output;          // a view's hours as colours, a PNG; of vertices a PLY
    std::string pfm;             // a view's hours, -1 where nothing is
    std::string csv;             // a row for each receiver; not of vertices
    std::string report;          // a folder: a view's page with a slider over the times
    bool isResumed = false;      // go on with what a killed run left beside the first of these
};

/// What was computed, for who asked.
struct SunHoursSummary {
    std::size_t receivers = 0; // pixels that see the model, points, vertices
    std::size_t steps = 0;
    std::uint32_t stepsUp = 0; // in which the Sun is up
    std::uint64_t samples = 0; // that faced it, summed over those that were decided now
    std::uint64_t touching = 0;
    std::string detail; // what the level of detail errs by, with its unit
};

} // namespace gnomon::measure
