// Computes delta T, the difference between uniform time and the rotation of the Earth.
#pragma once

#include "sun/civil_time.h"

namespace gnomon::sun {

/// Returns delta T, which is TT - UT1, in seconds at `date`. From 1972 on, the function uses the announced leap seconds
/// of UTC and takes UT1 as UTC, with an error of at most 0.9 s. For other dates, it uses the polynomials of Espenak and
/// Meeus, "Five Millennium Canon of Solar Eclipses" (NASA/TP-2006-214141, 2006), section 2.7. Their error is below 2 s
/// from 1800 to 1972, and unknown in the future. One second moves the Sun relative to the stars by 0.00001 degrees.
double deltaT(const JulianDate& date);

/// The last year that the table of leap seconds covers.
inline constexpr int kLastYearOfLeapSeconds = 2025;

} // namespace gnomon::sun
