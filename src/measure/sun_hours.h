// Hours of sun of a model.
#pragma once

#include "core/progress.h"
#include "measure/sun_hours_task.h"

#include <optional>
#include <string>

namespace gnomon::measure {

/// Computes and writes them; files appear when they are complete. Throws Error, UsageError for what contradicts itself,
/// and what `progress` throws: then a file beside the first output holds what was done, for a task with `isResumed`.
/// Returns nothing in a rank that does not lead the team.
std::optional<SunHoursSummary> computeSunHours(const SunHoursTask& task, Progress& progress);

/// What was computed, in a line; each time errs by up to half of `stepSeconds`.
std::string summaryText(const SunHoursSummary& summary, double stepSeconds);

/// What was computed as JSON.
std::string summaryJson(const SunHoursSummary& summary);

} // namespace gnomon::measure
