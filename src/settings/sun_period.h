// The period and the settings that an analysis of sun hours accepts.
#pragma once

#include "settings/settings.h"
#include "sun/sun_period.h"

namespace gnomon::settings {

/// The max number of steps of a period.
inline constexpr double kMaxSunSteps = 1e6;

/// Throws UsageError if the number of steps whose middle is in the period is 0 or above kMaxSunSteps.
void requireSteps(const sun::SunPeriod& period);

/// Returns `settings` for sun hours: with exact shadows, the software backend, and a view from above if no camera is
/// given. Throws UsageError if the settings give another light, other shadows or another backend.
Settings sunHoursSettings(const Settings& settings);

/// Throws UsageError if `settings` contain a light or a view. Sun hours of points or vertices use neither of them.
void requirePointHours(const Settings& settings);

} // namespace gnomon::settings
