// Computes sun hours of a model, from the options to the output files.
#pragma once

#include "core/progress.h"
#include "task/sun_hours_task.h"

#include <optional>
#include <string>

namespace gnomon::task {

/// Computes the sun hours that `task` requests and writes the output files. Each file appears when it is complete.
/// Throws Error, UsageError for options that contradict each other, and Interrupted. After an exception, a log in the
/// folder of the first output contains the finished time steps, and a task with `isResumed` continues from it. Returns
/// nullopt in all ranks of an MPI job except rank 0.
std::optional<SunHoursSummary> computeSunHours(const SunHoursTask& task, Progress& progress);

/// Returns the summary of a sun hours computation as one line of text. `stepSeconds` is the length of a time step, from
/// which the error of the times follows.
std::string summaryText(const SunHoursSummary& summary, double stepSeconds);

/// Returns the summary as JSON.
std::string summaryJson(const SunHoursSummary& summary);

} // namespace gnomon::task
