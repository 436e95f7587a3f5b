// Hours of sun of a model.
#pragma once

#include "core/progress.h"
#include "measure/sun_hours_task.h"

namespace gnomon::measure {

/// Computes and writes them; files appear when they are complete. Throws Error, UsageError for what contradicts itself,
/// and what `progress` throws: then a file beside the first output holds what was done, for a task with `isResumed`.
SunHoursSummary computeSunHours(const SunHoursTask& task, Progress& progress);

} // namespace gnomon::measure
