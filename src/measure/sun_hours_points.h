// Hours of sun of points and of vertices.
#pragma once

#include "core/progress.h"
#include "measure/sun_hours_task.h"

namespace gnomon::measure {

/// Hours of sun of a task's points or vertices; nothing in a rank that does not lead the team.
std::optional<SunHoursSummary> computePointHours(const SunHoursTask& task, Progress& progress);

} // namespace gnomon::measure
