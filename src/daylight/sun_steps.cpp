#include "daylight/sun_steps.h"

#include "settings/sun_settings.h"

namespace gnomon::daylight {

std::vector<SunStep> sunSteps(const settings::SunPeriod& period) {
    constexpr double kSecondsOfDay = 86400;
    const sun::JulianDate from = sun::julianDate(period.from);
    std::vector<SunStep> result(settings::stepCount(period));
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double middle = (static_cast<double>(i) + 0.5) * period.stepSeconds;
        const sun::JulianDate date{from.midnight, from.fraction + middle / kSecondsOfDay};
        const sun::SunPosition sun = sun::sunPosition(date, period.place, {});
        result[i].time = sun::written(date, period.from.offsetMinutes);
        result[i].isUp = sun.elevationRefracted > 0;
        if (result[i].isUp) result[i].light = roundedLight(settings::towardsSun(sun, period.northDegrees, period.up));
    }
    return result;
}

} // namespace gnomon::daylight
