#include "sun/sun_period.h"

#include "core/angle.h"
#include "hierarchy/upright_frame.h"

#include <cmath>

namespace gnomon::sun {

double secondsOf(const SunPeriod& period) {
    constexpr double kSecondsOfDay = 86400;
    const JulianDate from = julianDate(period.from);
    const JulianDate to = julianDate(period.to);
    return ((to.midnight - from.midnight) + (to.fraction - from.fraction)) * kSecondsOfDay;
}

double stepCount(const SunPeriod& period) {
    // A rounding error of one microsecond in the dates does not change the number of steps.
    return std::ceil(secondsOf(period) / period.stepSeconds - 0.5 - 1e-6 / period.stepSeconds);
}

glm::dvec3 towardsSun(const SunPosition& sun, double north, const glm::dvec3& up) {
    const double azimuth = radiansFromDegrees(sun.azimuth + north);
    const double elevation = radiansFromDegrees(sun.elevationRefracted);
    const double level = std::cos(elevation);
    return hierarchy::uprightFrame(up).toWorld(
        {level * std::sin(azimuth), std::sin(elevation), -level * std::cos(azimuth)});
}

} // namespace gnomon::sun
