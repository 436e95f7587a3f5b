// Checks the period of time and the settings of an analysis of sun hours.
#pragma once

#include "settings/settings.h"
#include "sun/sun_period.h"

namespace gnomon::settings {

/// The max number of time steps of an analysis of sun hours.
inline constexpr double kMaxSunSteps = 1e6;

/// Throws UsageError if `period` is too short for one time step, or has more than kMaxSunSteps steps. A step counts if
/// its middle is in the period.
void requireSteps(const sun::SunPeriod& period);

/// Returns `settings` changed for an analysis of sun hours: exact shadows, the software backend, and a view from above
/// if no camera is given. Throws UsageError if the settings request another light, other shadows or another backend.
Settings sunHoursSettings(const Settings& settings);

/// Throws UsageError if `settings` contain a light or a view. An analysis of sun hours at points or vertices uses
/// neither of them.
void requirePointHours(const Settings& settings);

} // namespace gnomon::settings
