#include "settings/sun_period.h"

#include "settings/backend_choice.h"
#include "settings/resolve.h"
#include "settings/table.h"
#include "settings/usage_error.h"

namespace gnomon::settings {

void requireSteps(const sun::SunPeriod& period) {
    if (!(sun::secondsOf(period) > 0)) throw UsageError{"--to", "--to must be later than --from"};
    const double steps = sun::stepCount(period);
    if (steps < 1) throw UsageError{"--step", "--step must be at most twice the time from --from to --to"};
    if (steps > kMaxSunSteps)
        throw UsageError{"--step", "--step is too short: expected at most 1,000,000 steps from --from to --to"};
}

Settings sunHoursSettings(const Settings& settings) {
    Settings result = settings;
    if (result.sun) throw UsageError{"--sun", "--sun is for a single time; use --at, --from and --to"};
    if (result.isLightGiven)
        throw UsageError{"--light", "--light and --at contradict each other: the Sun is the light"};
    if (result.quality.shadows != plan::ShadowMode::Auto && result.quality.shadows != plan::ShadowMode::Exact)
        throw UsageError{"--shadows", "--shadows: expected exact, because sun hours always use exact shadows"};
    if (result.backend != Backend::Auto && result.backend != Backend::Software)
        throw UsageError{
            "--backend",
            optionText("backend", result) +
                " and sun hours contradict each other: " + onlySoftware(&plan::Capabilities::exactShadows)};
    if (result.quality.mapsBecause)
        throw UsageError{"--shadows", "sun hours use exact shadows; remove the options of shadow maps"};
    if (result.sunAngleDegrees.value_or(0) > 0 || result.quality.sky.directions > 0)
        throw UsageError{"--sun-angle", "--sun-angle and --sky are for pictures; sun hours use the centre of the Sun"};
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
            "--points", "--points and --vertices need no view; remove --camera, --eye, --target, --view and --fov-y"};
}

} // namespace gnomon::settings
