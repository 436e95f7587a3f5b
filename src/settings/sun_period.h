// The period of an analysis of sun hours, and the settings that such an analysis accepts.
#pragma once

#include "settings/settings.h"

namespace gnomon::settings {

/// The period [from, to) at a place, in steps of `stepSeconds`. `up` is the up direction of the world. True north is
/// `northDegrees` clockwise of the model's north, seen from above (see `towardsSun`).
struct SunPeriod {
    sun::Place place;
    sun::CivilTime from;
    sun::CivilTime to;
    double stepSeconds = 900;
    double northDegrees = 0;
    glm::dvec3 up{0, 1, 0};
};

/// The max number of steps of a period.
inline constexpr double kMostSunSteps = 1e6;

/// Returns the number of steps whose middle is in the period. Throws UsageError if it is 0 or above kMostSunSteps.
std::size_t stepCount(const SunPeriod& period);

/// Returns `settings` for sun hours: with exact shadows, the software backend, and a view from above if no camera is
/// given. Throws UsageError if the settings give another light, other shadows or another backend.
Settings sunHoursSettings(const Settings& settings);

/// Throws UsageError if `settings` give a light or a view. Sun hours of points or vertices use neither of them.
void requirePointHours(const Settings& settings);

} // namespace gnomon::settings
