// Computes the position of the Sun in the sky of a place on the earth.
#pragma once

#include "sun/civil_time.h"

#include <optional>

namespace gnomon::sun {

/// A place on the WGS 84 ellipsoid.
struct Place {
    double latitude = 0;  // degrees, north is positive, -90 to 90
    double longitude = 0; // degrees, east is positive, -180 to 180
    double height = 0;    // metres above the ellipsoid
};

/// The state of the air, which determines the refraction of sunlight.
struct Air {
    double pressure = 1010;  // hectopascals; 0: no refraction
    double temperature = 10; // degrees Celsius
};

/// The direction to the centre of the Sun's disc as seen from a place on the earth (topocentric), in degrees.
struct SunPosition {
    double azimuth = 0;            // from north towards east, [0, 360)
    double elevation = 0;          // above the plane perpendicular to the ellipsoid's normal
    double elevationRefracted = 0; // with refraction; the same below the horizon
    double hourAngle = 0;          // after the meridian, (-180, 180]
    double diameter = 0;           // of the disc
};

/// Returns the position of the Sun in the sky at `date`, seen from `place`. `date` is UTC and is used as UT1, with an
/// error of up to 0.9 s or 0.004 degrees. `deltaT` is TT - UT1 in seconds; the default is deltaT(date).
///
/// The function uses the astronomy routines of the IAU (ERFA, which is SOFA under another licence): the orbit of the
/// Earth (Epv00, a truncated VSOP2000, accurate to 14 km from 1900 to 2100), annual aberration, precession and nutation
/// 2000B, and parallax. It omits effects below 0.0001 degrees: polar motion, diurnal aberration, and the deflection of
/// light by the Sun. Refraction is by Bennett (1982) in the form of Reda and Andreas, "Solar Position Algorithm"
/// (NREL/TP-560-34302, 2003), equation 42. It applies down to the elevation at which the upper edge sets.
SunPosition sunPosition(
    const JulianDate& date, const Place& place, const Air& air, std::optional<double> deltaT = std::nullopt);

} // namespace gnomon::sun
