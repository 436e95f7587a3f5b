#include "sun/sun_day.h"

namespace gnomon::sun {
namespace {

constexpr double kRefractionAtTheHorizon = 34.0 / 60; // degrees

JulianDate later(const JulianDate& date, double days) {
    return {date.midnight, date.fraction + days};
}

// Returns the height of the upper edge of the Sun's disc above the horizon, in degrees.
double height(const JulianDate& date, const Place& place, const Air& air) {
    const SunPosition sun = sunPosition(date, place, {.pressure = 0, .temperature = 0});
    return sun.elevation + sun.diameter / 2 + (air.pressure > 0 ? kRefractionAtTheHorizon : 0);
}

// Returns the time between `low` and `high` at which the Sun crosses the horizon. Returns nullopt unless the Sun is
// below the horizon at `low` and above it at `high`.
std::optional<JulianDate> crossing(JulianDate low, JulianDate high, const Place& place, const Air& air) {
    if (height(low, place, air) >= 0 || height(high, place, air) < 0) return std::nullopt;
    for (int halving = 0; halving < 24; ++halving) { // half a day divided by 2^24: 3 ms
        const JulianDate middle{low.midnight, (low.fraction + high.fraction) / 2};
        (height(middle, place, air) < 0 ? low : high) = middle;
    }
    return high;
}

// Returns the time near `start` at which the hour angle of the Sun is `angle` degrees. It is 0 at solar noon.
JulianDate meridian(JulianDate start, const Place& place, double angle) {
    for (int step = 0; step < 4; ++step) { // each step leaves an error of the Sun's own motion, 1/365 of a revolution
        double past = sunPosition(start, place, {}).hourAngle - angle;
        past += past < -180 ? 360 : past > 180 ? -360 : 0;
        start.fraction -= past / 360;
    }
    return start;
}

} // namespace

SunDay sunDay(const CivilTime& time, const Place& place, const Air& air) {
    CivilTime noon = time;
    noon.hour = 12;
    noon.minute = 0;
    noon.second = 0;
    SunDay day;
    day.noon = meridian(julianDate(noon), place, 0);
    day.upAtNoon = height(day.noon, place, air) >= 0;
    day.sunrise = crossing(meridian(later(day.noon, -0.5), place, 180), day.noon, place, air);
    day.sunset = crossing(meridian(later(day.noon, 0.5), place, 180), day.noon, place, air);
    return day;
}

} // namespace gnomon::sun
