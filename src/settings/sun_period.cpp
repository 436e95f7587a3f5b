#include "settings/sun_period.h"

#include "settings/backend_choice.h"
#include "settings/resolve.h"
#include "settings/table.h"
#include "settings/usage_error.h"

namespace gnomon::settings {

void requireSteps(const sun::SunPeriod& period) {
    if (!(sun::secondsOf(period) > 0)) throw UsageError{"--to", "--to has to be later than --from"};
    const double steps = sun::stepCount(period);
    if (steps < 1) throw UsageError{"--step", "--step is more than twice the time from --from to --to"};
    if (steps > kMaxSunSteps)
        throw UsageError{"--step", "--step is too short: more than a million steps from --from to --to"};
}

Settings sunHoursSettings(const Settings& settings) {
    Settings result = settings;
    if (result.sun) throw UsageError{"--sun", "--sun is of one picture: sun hours has --at, --from and --to"};
    if (result.isLightGiven) throw UsageError{"--light", "--light contradicts --at: the light is the sun's"};
    if (result.quality.shadows != plan::ShadowMode::Auto && result.quality.shadows != plan::ShadowMode::Exact)
        throw UsageError{"--shadows", "--shadows: hours of sun are counted by exact shadows alone"};
    if (result.backend != Backend::Auto && result.backend != Backend::Software)
        throw UsageError{
            "--backend",
            optionText("backend", result) +
                " and sun hours contradict each other: " + onlySoftware(&plan::Capabilities::exactShadows)};
    if (result.quality.mapsBecause)
        throw UsageError{"--shadows", "hours of sun are counted by exact shadows: no option of maps goes with them"};
    if (result.sunAngleDegrees.value_or(0) > 0 || result.quality.sky.directions > 0)
        throw UsageError{
            "--sun-angle", "--sun-angle and --sky are of pictures: hours of sun are counted for a sun that is a point"};
    result.north.reset();
    if (!isPosed(result)) result.side = path::ViewSide::Top;
    result.quality.shadows = plan::ShadowMode::Exact;
    result.backend = Backend::Software;
    return result;
}

void requirePointHours(const Settings& settings) {
    sunHoursSettings(settings);
    if (isPosed(settings))
        throw UsageError{
            "--points", "--points and --vertices have no view: no --camera, --eye or --view goes with them"};
}

} // namespace gnomon::settings
