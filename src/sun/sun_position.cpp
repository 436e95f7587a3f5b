#include "sun/sun_position.h"

#include "sun/delta_t.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <erfa.h>
#include <erfam.h>

namespace gnomon::sun {
namespace {

constexpr double kDegree = ERFA_DPI / 180;

constexpr double kAstronomicalUnitsADayOfLight = kSecondsInADay / ERFA_AULT;
constexpr double kSunRadius = 959.63 * ERFA_DAS2R; // angular radius at one astronomical unit, IAU 1976

using Vector = std::array<double, 3>;

// Returns the apparent position of the Sun as seen from the Earth's centre, in astronomical units, in the frame of the
// equator and equinox of date.
Vector geocentricSun(double midnight, double terrestrialFraction) {
    double heliocentric[2][3];
    double barycentric[2][3];
    // Outside the years 1900 to 2100, eraEpv00 returns a warning but still computes the result.
    eraEpv00(midnight, terrestrialFraction, heliocentric, barycentric);
    Vector sun;
    Vector direction;
    Vector velocity;
    double speed2 = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        sun[k] = -heliocentric[0][k];
        velocity[k] = barycentric[1][k] / kAstronomicalUnitsADayOfLight;
        speed2 += velocity[k] * velocity[k];
    }
    double distance = 0;
    eraPn(sun.data(), &distance, direction.data());
    Vector apparent;
    eraAb(direction.data(), velocity.data(), distance, std::sqrt(1 - speed2), apparent.data());
    double toDate[3][3];
    eraPnm00b(midnight, terrestrialFraction, toDate);
    Vector ofDate;
    eraRxp(toDate, apparent.data(), ofDate.data());
    for (double& part : ofDate)
        part *= distance;
    return ofDate;
}

// Returns the refraction of sunlight in degrees for a body at `elevation` (degrees).
double refraction(double elevation, const Air& air) {
    const double lowest = -(0.26667 + 0.5667); // elevation of the centre when the upper edge sets
    if (air.pressure <= 0 || elevation < lowest) return 0;
    return air.pressure / 1010 * 283 / (273 + air.temperature) * 1.02 /
           (60 * std::tan((elevation + 10.3 / (elevation + 5.11)) * kDegree));
}

} // namespace

SunPosition sunPosition(const JulianDate& date, const Place& place, const Air& air, std::optional<double> deltaT) {
    const double lag = deltaT ? *deltaT : sun::deltaT(date);
    const double terrestrial = date.fraction + lag / kSecondsInADay;
    Vector sun = geocentricSun(date.midnight, terrestrial);

    // Rotates the position with the Earth, so that the first axis lies in the meridian of Greenwich.
    const double turn = eraGst00b(date.midnight, date.fraction);
    double rotation[3][3];
    eraIr(rotation);
    eraRz(turn, rotation);
    eraRxp(rotation, sun.data(), sun.data());

    const double longitude = place.longitude * kDegree;
    const double latitude = place.latitude * kDegree;
    Vector observer;
    // The result is not checked, because this call does not fail for a finite place on an ellipsoid.
    eraGd2gc(ERFA_WGS84, longitude, latitude, place.height, observer.data());
    for (std::size_t k = 0; k < 3; ++k)
        sun[k] -= observer[k] / ERFA_DAU;

    // Components of the Sun's position in the meridian of the place: away from the Earth's axis, east, and along the
    // axis.
    const double out = std::cos(longitude) * sun[0] + std::sin(longitude) * sun[1];
    const double east = -std::sin(longitude) * sun[0] + std::cos(longitude) * sun[1];
    const double up = std::cos(latitude) * out + std::sin(latitude) * sun[2];
    const double north = -std::sin(latitude) * out + std::cos(latitude) * sun[2];

    SunPosition position;
    const double azimuth = std::atan2(east, north) / kDegree;
    position.azimuth = azimuth < 0 ? azimuth + 360 : azimuth;
    position.elevation = std::atan2(up, std::hypot(east, north)) / kDegree;
    position.elevationRefracted = position.elevation + refraction(position.elevation, air);
    position.hourAngle = std::atan2(-east, out) / kDegree;
    position.diameter = 2 * std::asin(std::sin(kSunRadius) / std::hypot(out, east, sun[2])) / kDegree;
    return position;
}

} // namespace gnomon::sun
