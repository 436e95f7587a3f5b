// Computes the times of sunrise, solar noon and sunset.
#pragma once

#include "sun/sun_position.h"

#include <cstdint>
#include <optional>

namespace gnomon::sun {

/// The solar noon of a day, the sunrise before it and the sunset after it. Sunrise and sunset are empty if the Sun does
/// not cross the horizon.
struct SunDay {
    JulianDate noon; // the centre of the disc crosses the meridian
    std::optional<JulianDate> sunrise;
    std::optional<JulianDate> sunset;
    bool upAtNoon = false;
};

/// Returns noon, sunrise and sunset at `place`. The noon is the one nearest to 12:00 on the date of `time`, in the
/// clock of `time`. Sunrise is the moment when the upper edge of the Sun's disc crosses the horizon. Refraction lifts
/// the disc by 34 arc minutes, as in almanacs, or by 0 if `air` has no pressure. The results are exact to a second,
/// except near the poles, where the Sun moves along the horizon.
SunDay sunDay(const CivilTime& time, const Place& place, const Air& air);

} // namespace gnomon::sun
