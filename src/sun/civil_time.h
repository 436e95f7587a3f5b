// A moment as people write it, and as astronomers count it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gnomon::sun {

constexpr double kSecondsInADay = 86400; // leap seconds aside

/// Date and time of day by a clock that is `offsetMinutes` ahead of UTC, in the Gregorian calendar, for years before
/// it began too.
struct CivilTime {
    int year = 2000;
    int month = 1;         // 1 to 12
    int day = 1;           // 1 to the month's length
    int hour = 0;          // 0 to 23
    int minute = 0;        // 0 to 59
    double second = 0;     // [0, 60)
    int offsetMinutes = 0; // -840 to 840
};

/// A Julian date in two parts, so that doubles hold less than a microsecond of it: that of a midnight, and what is to
/// be added to it, in days, of either sign and any size.
struct JulianDate {
    double midnight = 0;
    double fraction = 0;
};

/// The moment that `text` writes in ISO 8601 with an offset, "2026-06-21T12:00-07:00", seconds and their decimals as
/// one likes, "Z" for UTC; none if it is anything else, or lies outside the years from 1 to 9999.
std::optional<CivilTime> parseCivilTime(std::string_view text);

/// `time` in UTC.
JulianDate julianDate(const CivilTime& time);

/// The moment `date`, which is in UTC, as ISO 8601 by a clock that is `offsetMinutes` ahead, to the nearest second.
std::string written(const JulianDate& date, int offsetMinutes);

} // namespace gnomon::sun
