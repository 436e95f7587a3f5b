// How far the Earth's turn lags behind clocks.
#pragma once

#include "sun/civil_time.h"

namespace gnomon::sun {

/// TT - UT1 in seconds at `date`: the leap seconds of UTC from 1972 on, as far as they are announced (then UT1 is taken
/// for UTC, which errs by at most 0.9 s), else the polynomials of Espenak and Meeus, "Five Millennium Canon of Solar
/// Eclipses" (NASA/TP-2006-214141, 2006), section 2.7, which err by less than 2 s from 1800 to 1972 and by an unknown
/// amount in times to come. A second moves the Sun among the stars by 0.00001 degrees.
double deltaT(const JulianDate& date);

/// The last year for which leap seconds are taken as announced.
inline constexpr int kLastYearOfLeapSeconds = 2025;

} // namespace gnomon::sun
