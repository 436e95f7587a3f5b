#include "settings/sun_codecs.h"

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

} // namespace gnomon::settings
