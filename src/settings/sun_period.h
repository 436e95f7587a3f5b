// A period over which hours of sun are counted, and what settings of a view mean there.
#pragma once

#include "settings/settings.h"

namespace gnomon::settings {

/// [from, to) in steps, in a world whose true north lies `northDegrees` clockwise of its own, seen from above, and in
/// which `up` is up.
struct SunPeriod {
    sun::Place place;
    sun::CivilTime from;
    sun::CivilTime to;
    double stepSeconds = 900;
    double northDegrees = 0;
    glm::dvec3 up{0, 1, 0};
};

/// More steps than that are refused.
inline constexpr double kMostSunSteps = 1e6;

/// How many steps have their middles in the period. Throws UsageError where there is none, or too many.
std::size_t stepCount(const SunPeriod& period);

/// `settings` for hours of sun: from above where they pose no camera, by exact shadows, without a light of their own.
/// Throws UsageError for what contradicts that.
Settings sunHoursSettings(const Settings& settings);

/// Throws UsageError where `settings` ask for a light or a view, which hours of sun of points have none of.
void requirePointHours(const Settings& settings);

} // namespace gnomon::settings
