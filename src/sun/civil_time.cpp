#include "sun/civil_time.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <erfa.h>

namespace gnomon::sun {
namespace {

// A parser that reads characters from the front of a text. A mismatch sets `good` to false.
struct Reader {
    std::string_view rest;
    bool good = true;

    bool take(char expected) {
        if (rest.empty() || rest.front() != expected) return false;
        rest.remove_prefix(1);
        return true;
    }

    void require(char expected) { good = take(expected) && good; }

    int digits(std::size_t count) {
        int value = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (rest.size() <= i || rest[i] < '0' || rest[i] > '9') {
                good = false;
                return 0;
            }
            value = 10 * value + (rest[i] - '0');
        }
        rest.remove_prefix(count);
        return value;
    }

    // Reads seconds as two digits, and decimals after a point if present.
    double seconds() {
        const std::string_view start = rest;
        double value = digits(2);
        if (!good || !take('.')) return value;
        std::size_t decimals = 0;
        while (decimals < rest.size() && rest[decimals] >= '0' && rest[decimals] <= '9')
            ++decimals;
        good = decimals > 0;
        std::from_chars(start.data(), start.data() + 3 + decimals, value);
        rest.remove_prefix(decimals);
        return value;
    }
};

int readOffset(Reader& reader) {
    if (reader.take('Z')) return 0;
    const bool behind = reader.take('-');
    if (!behind) reader.require('+');
    const int hours = reader.digits(2);
    reader.take(':');
    const int minutes = reader.digits(2);
    if (minutes > 59 || hours * 60 + minutes > 14 * 60) reader.good = false;
    return (behind ? -1 : 1) * (hours * 60 + minutes);
}

} // namespace

std::optional<CivilTime> parseCivilTime(std::string_view text) {
    Reader reader{text};
    CivilTime time;
    time.year = reader.digits(4);
    reader.require('-');
    time.month = reader.digits(2);
    reader.require('-');
    time.day = reader.digits(2);
    reader.require('T');
    time.hour = reader.digits(2);
    reader.require(':');
    time.minute = reader.digits(2);
    if (reader.take(':')) time.second = reader.seconds();
    time.offsetMinutes = readOffset(reader);
    double days = 0;
    double day = 0;
    if (!reader.good || !reader.rest.empty() || time.year < 1 || time.hour > 23 || time.minute > 59 ||
        time.second >= 60 || eraCal2jd(time.year, time.month, time.day, &days, &day) != 0)
        return std::nullopt;
    return time;
}

JulianDate julianDate(const CivilTime& time) {
    JulianDate date;
    double day = 0;
    eraCal2jd(time.year, time.month, time.day, &date.midnight, &day);
    date.midnight += day;
    date.fraction = (time.hour * 3600 + (time.minute - time.offsetMinutes) * 60 + time.second) / kSecondsInADay;
    return date;
}

std::string written(const JulianDate& date, int offsetMinutes) {
    const double seconds = std::round(date.fraction * kSecondsInADay) + offsetMinutes * 60;
    const double days = std::floor(seconds / kSecondsInADay);
    const int ofDay = static_cast<int>(seconds - days * kSecondsInADay);
    int year = 0;
    int month = 0;
    int day = 0;
    double none = 0;
    eraJd2cal(date.midnight, days, &year, &month, &day, &none);
    const int offset = std::abs(offsetMinutes);
    std::array<char, 80> text{};
    std::snprintf(
        text.data(),
        text.size(),
        "%04d-%02d-%02dT%02d:%02d:%02d%c%02d:%02d",
        year,
        month,
        day,
        ofDay / 3600,
        ofDay / 60 % 60,
        ofDay % 60,
        offsetMinutes < 0 ? '-' : '+',
        offset / 60,
        offset % 60);
    return text.data();
}

} // namespace gnomon::sun
