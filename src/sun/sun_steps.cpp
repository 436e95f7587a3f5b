#include "sun/sun_steps.h"

#include <algorithm>

namespace gnomon::sun {

std::vector<SunStep> sunSteps(const SunPeriod& period) {
    constexpr double kSecondsOfDay = 86400;
    const JulianDate from = julianDate(period.from);
    std::vector<SunStep> result(static_cast<std::size_t>(std::max(0.0, stepCount(period))));
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double middle = (static_cast<double>(i) + 0.5) * period.stepSeconds;
        const JulianDate date{from.midnight, from.fraction + middle / kSecondsOfDay};
        const SunPosition sun = sunPosition(date, period.place, {});
        result[i].time = written(date, period.from.offsetMinutes);
        result[i].isUp = sun.elevationRefracted > 0;
        if (result[i].isUp) result[i].light = roundedLight(towardsSun(sun, period.northDegrees, period.up));
    }
    return result;
}

} // namespace gnomon::sun
