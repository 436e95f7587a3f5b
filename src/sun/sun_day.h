// When the Sun rises, stands highest and sets.
#pragma once

#include "sun/sun_position.h"

#include <cstdint>
#include <optional>

namespace gnomon::sun {

/// The noon of a day, and the rise before it and the set behind it; none where the Sun stays up, or down.
struct SunDay {
    JulianDate noon; // the disc's centre crosses the meridian
    std::optional<JulianDate> sunrise;
    std::optional<JulianDate> sunset;
    bool upAtNoon = false;
};

/// The day whose noon is nearest to 12:00 of the date of `time`, by its clock, in `place`. The Sun rises when the upper
/// edge of its disc meets the horizon, lifted by 34 minutes of arc as almanacs have it, or by none where `air` has no
/// pressure. To the second, but near the poles, where it moves along the horizon.
SunDay sunDay(const CivilTime& time, const Place& place, const Air& air);

} // namespace gnomon::sun
