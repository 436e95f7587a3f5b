#include "settings/sun_settings.h"

#include "core/angle.h"
#include "core/formatted.h"
#include "hierarchy/main_part.h"
#include "hierarchy/upright_frame.h"
#include "path/framing.h"
#include "settings/setting_place.h"
#include "sun/sun_day.h"
#include "sun/sun_period.h"

#include <cmath>

namespace gnomon::settings {
namespace {

std::optional<sun::Place> placeOf(const std::string& text) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos) return std::nullopt;
    const Codec<double> degrees = anyNumber();
    const std::optional<double> latitude = degrees.read(text.substr(0, comma));
    const std::optional<double> longitude = degrees.read(text.substr(comma + 1));
    if (!latitude || !longitude || std::abs(*latitude) > 90 || std::abs(*longitude) > 180) return std::nullopt;
    return sun::Place{.latitude = *latitude, .longitude = *longitude};
}

constexpr double kSecondsOfMinute = 60;
constexpr double kSecondsOfHour = 3600;

std::optional<double> secondsOf(const std::string& text) {
    if (text.empty()) return std::nullopt;
    const char unit = text.back();
    const double seconds = unit == 'h' ? kSecondsOfHour : unit == 'm' ? kSecondsOfMinute : unit == 's' ? 1 : 0;
    const std::optional<double> count = positiveNumber().read(text.substr(0, text.size() - 1));
    return count && seconds > 0 ? std::optional(*count * seconds) : std::nullopt;
}

std::optional<SunTime> sunTimeOf(const std::string& text) {
    const std::size_t comma = text.rfind(',');
    if (comma == std::string::npos) return std::nullopt;
    const auto where = placeOf(text.substr(0, comma));
    const auto when = sun::parseCivilTime(text.substr(comma + 1));
    return where && when ? std::optional(sunAt(*where, *when)) : std::nullopt;
}

std::string upTimes(const SunTime& asked) {
    const sun::SunDay day = sun::sunDay(asked.time, asked.place, {});
    if (!day.sunrise || !day.sunset) return "and stays so that day";
    const int offset = asked.time.offsetMinutes;
    return "it is up from " + sun::written(*day.sunrise, offset) + " to " + sun::written(*day.sunset, offset);
}

} // namespace

Codec<sun::Place> place() {
    return {
        placeOf,
        [](const sun::Place& place) { return shortest(place.latitude) + "," + shortest(place.longitude); },
        "LAT,LON in degrees, north and east positive, up to 90 and 180"};
}

Codec<sun::CivilTime> moment() {
    return {
        [](const std::string& text) { return sun::parseCivilTime(text); },
        [](const sun::CivilTime& time) { return sun::written(sun::julianDate(time), time.offsetMinutes); },
        "a date and time with its offset from UTC, such as 2026-06-21T12:00+02:00"};
}

Codec<double> duration() {
    return {secondsOf, [](double seconds) { return shortest(seconds) + "s"; }, "a time such as 5m, 90s or 1h"};
}

Codec<SunTime> sunTime() {
    return {
        sunTimeOf,
        [](const SunTime& value) { return place().write(value.place) + "," + moment().write(value.time); },
        "LAT,LON,TIME, such as 47.4,8.5,2026-06-21T12:00+02:00"};
}

Codec<plan::SkyLight> skyLight() {
    constexpr int kMaxDirections = 4096;
    return {
        [](const std::string& text) -> std::optional<plan::SkyLight> {
            const std::size_t comma = text.find(',');
            const auto directions = whole(0, kMaxDirections).read(text.substr(0, comma));
            if (!directions) return std::nullopt;
            if (comma == std::string::npos) return plan::SkyLight{*directions};
            const auto model = valueOf(plan::kSkyModels, text.substr(comma + 1));
            return model ? std::optional(plan::SkyLight{*directions, *model}) : std::nullopt;
        },
        [](const plan::SkyLight& value) {
            return std::to_string(value.directions) + (value.model == plan::SkyModel::Uniform
                                                           ? ""
                                                           : "," + std::string(wordOf(plan::kSkyModels, value.model)));
        },
        "a whole number of directions from 0 to " + std::to_string(kMaxDirections) +
            ", with ,uniform or ,overcast behind it"};
}

std::vector<Setting> sunSettings() {
    return {
        plain(
            &Settings::sun,
            {.name = "sun",
             .form = "LAT,LON,TIME",
             .help = "Sunlight at a place and time: 47.4,8.5,2026-06-21T12:00+02:00",
             .statedAs = "sun"},
            ifGiven(sunTime())),
        plain(
            &Settings::lightAt,
            {.name = "light-at",
             .form = "x,y,z",
             .help = "Position of a lamp that replaces the sun; its light decreases with the square of the distance",
             .statedAs = "light_at"},
            ifGiven(vector())),
        plain(
            &Settings::north,
            {.name = "north",
             .form = "DEG",
             .help = "Direction of true north in degrees, clockwise seen from above, from -z if y is up and from y if "
                     "z is up",
             .usually = "0",
             .statedAs = "north"},
            ifGiven(number("an angle from -360 to 360 degrees", [](double v) { return std::abs(v) <= 360; }))),
        plain(
            &Settings::sunAngleDegrees,
            {.name = "sun-angle",
             .form = "DEG",
             .help = "Angular width of the light in degrees, for soft shadow edges in pictures; 0 is a point",
             .usually = "that of the Sun with --sun, else 0"},
            ifGiven(number("an angle from 0 to 90 degrees", [](double v) { return v >= 0 && v <= 90; }))),
        quality(
            &plan::Quality::lightError,
            {.name = "light-error",
             .form = "E",
             .help =
                 "Max error of the light from --sun-angle, a fraction from 0.003 to 0.5; a smaller error needs more "
                 "frames"},
            number("a number from 0.003 to 0.5", [](double v) { return v >= 0.003 && v <= 0.5; })),
        quality(
            &plan::Quality::sky,
            {.name = "sky", .form = "N[,MODEL]", .help = "Number of directions of sky light, or N,overcast"},
            skyLight()),
    };
}

SunTime sunAt(const sun::Place& place, const sun::CivilTime& time) {
    return {place, time, sun::sunPosition(sun::julianDate(time), place, {})};
}

void requireSunUp(const SunTime& asked) {
    if (asked.position.elevationRefracted > 0) return;
    throw UsageError{
        "--sun",
        formatted("--sun: the sun is below the horizon at this time, at %.1f degrees; ", asked.position.elevation) +
            upTimes(asked)};
}

namespace {

/// Returns the point of the vertex grid nearest to `at`, in world space. Throws UsageError if it is too far from the
/// origin of the grid.
glm::dvec3 onGrid(const glm::dvec3& at, const hierarchy::Grid& grid) {
    constexpr double kMaxCells = 0x1p51; // half the range of exact shadows, whose origin is near the eye
    const glm::dvec3 cell = glm::round((at - grid.origin) / grid.step());
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(cell[axis]) < kMaxCells))
            throw UsageError{
                "--light-at",
                "--light-at: the point light is too far from the model; use --light " + direction().write(at) +
                    " instead"};
    return grid.origin + cell * grid.step();
}

/// Returns the direction from the middle of the model to the point light, or `up` if the light is exactly there.
glm::dvec3 towardsPoint(const plan::PointLight& light, const Box& bounds, const glm::dvec3& up) {
    const glm::dvec3 towards = light.at - 0.5 * (bounds.min + bounds.max);
    return towards == glm::dvec3(0) ? up : towards;
}

} // namespace

std::optional<plan::PointLight> pointLightOf(const Settings& settings, const hierarchy::ModelSummary& model) {
    if (!settings.lightAt) return std::nullopt;
    plan::PointLight light;
    light.at = onGrid(*settings.lightAt, model.grid);
    constexpr double kOfDiagonal = 1.0 / 16;
    const double within = std::max(kOfDiagonal * glm::length(model.bounds.extent()), model.grid.step());
    light.reach = std::hypot(distance(model.bounds, light.at), within);
    return light;
}

double lightDiameter(const Settings& settings) {
    if (settings.sunAngleDegrees) return radiansFromDegrees(*settings.sunAngleDegrees);
    if (!settings.sun) return 0;
    return radiansFromDegrees(settings.sun->position.diameter);
}

void setLight(const Settings& settings, const hierarchy::ModelSummary& model, plan::View& view) {
    view.sunAngleRadians = lightDiameter(settings);
    view.pointLight = pointLightOf(settings, model);
    if (view.pointLight)
        view.towardsLight = towardsPoint(*view.pointLight, hierarchy::mainPartOf(model), view.up);
    else if (settings.sun)
        view.towardsLight = sun::towardsSun(settings.sun->position, settings.north.value_or(0), view.up);
    else
        view.towardsLight = settings.isLightGiven ? settings.towardsLight : path::usualLight(view.up);
}

} // namespace gnomon::settings
