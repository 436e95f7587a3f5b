// Computes the sun hours of points from a file, or of all vertices of a model.
#pragma once

#include "core/progress.h"
#include "task/sun_hours_task.h"

namespace gnomon::task {

/// Computes the sun hours of the points or vertices of `task` and writes the output file. Returns nullopt in all ranks
/// of an MPI job except rank 0. Throws Error and UsageError.
std::optional<SunHoursSummary> computePointHours(const SunHoursTask& task, Progress& progress);

} // namespace gnomon::task
