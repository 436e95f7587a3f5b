// The input and the summary of a computation of sun hours.
#pragma once

#include "settings/settings.h"
#include "sun/sun_period.h"
#include "task/sun_hours_team.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace gnomon::task {

/// The input of a sun hours computation: the tested points, the period and the output files. An empty path means that
/// the file is not requested. The tested points are the pixels of a view, the points of a file, or all vertices. For
/// points and vertices, shadows are cast by a cut of the model with the same error everywhere.
struct SunHoursTask {
    SunHoursTeam* team = nullptr; // the processes that compute together
    std::string model;
    settings::Settings settings; // view; without a given camera, the view is from above
    std::function<void(const std::string&)> warn;
    sun::SunPeriod period;       // `up` is ignored; the model gives the up direction
    std::string points;          // input: a CSV file with points x,y,z
    bool isOfVertices = false;   // true: vertices; false: the points of `points`, or a view if that is empty
    std::optional<double> error; // max error of the uniform cut, world units; nullopt: the finest level
    std::string output;          // for a view: PNG with hours as colours; for vertices: PLY
    std::string pfm;             // for a view: PFM with hours per pixel; -1 for the background
    std::string csv;             // CSV with one row per receiver; not for vertices
    std::string report;          // for a view: folder of a page with a slider over the times
    bool isResumed = false;      // continues from the logs of an interrupted run, in the folder of the first output
};

/// The totals of a sun hours computation, which the command prints.
struct SunHoursSummary {
    std::size_t receivers = 0; // pixels that show the model, points, or vertices
    std::size_t steps = 0;
    std::uint32_t stepsUp = 0;         // steps in which the Sun is up
    std::uint64_t samples = 0;         // receivers that faced the Sun, summed over the steps that this run computed
    std::uint64_t withinTolerance = 0; // samples whose result depends on the tolerance or on the rule for ties
    std::string detail;                // error of the level of detail, with its unit
};

} // namespace gnomon::task
