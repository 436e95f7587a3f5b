// Where the Sun stands in the sky of a place.
#pragma once

#include "sun/civil_time.h"

#include <optional>

namespace gnomon::sun {

/// A place on the ellipsoid of WGS 84.
struct Place {
    double latitude = 0;  // degrees, north is positive, -90 to 90
    double longitude = 0; // degrees, east is positive, -180 to 180
    double height = 0;    // metres above the ellipsoid
};

/// The air that bends light on its way.
struct Air {
    double pressure = 1010;  // hectopascals; 0: no refraction
    double temperature = 10; // degrees Celsius
};

/// Of the centre of the Sun's disc, seen from the place, not from the middle of the Earth; in degrees.
struct SunPosition {
    double azimuth = 0;            // from north by east, [0, 360)
    double elevation = 0;          // above the plane across the ellipsoid's normal
    double elevationRefracted = 0; // as the air shows it; the same below the horizon
    double hourAngle = 0;          // past the meridian, (-180, 180]
    double diameter = 0;           // of the disc
};

/// The Sun at `date` (UTC, taken for UT1: an error of up to 0.9 s, 0.004 degrees) in `place`. `deltaT` is TT - UT1 in
/// seconds, that of deltaT() if none is given. By the IAU's routines of astronomy (ERFA, which is SOFA under another
/// licence): the Earth's path (Epv00, VSOP2000 cut short, good to 14 km from 1900 to 2100), annual aberration,
/// precession and nutation of 2000B, parallax. Left out, since they are smaller than 0.0001 degrees: the motion of the
/// poles, the aberration by the Earth's turn, the bending of light by the Sun. Refraction by Bennett (1982) as in Reda
/// and Andreas, "Solar Position Algorithm" (NREL/TP-560-34302, 2003), equation 42, down to where the upper edge sets.
SunPosition sunPosition(
    const JulianDate& date, const Place& place, const Air& air, std::optional<double> deltaT = std::nullopt);

} // namespace gnomon::sun
