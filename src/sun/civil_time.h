// Represents a moment as civil time (date, clock and offset from UTC) and as a Julian date.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gnomon::sun {

constexpr double kSecondsInADay = 86400; // without leap seconds

/// A date and time on a clock that is `offsetMinutes` ahead of UTC. The date is in the Gregorian calendar, also for
/// years before its introduction.
struct CivilTime {
    int year = 2000;
    int month = 1;         // 1 to 12
    int day = 1;           // 1 to the length of the month
    int hour = 0;          // 0 to 23
    int minute = 0;        // 0 to 59
    double second = 0;     // [0, 60)
    int offsetMinutes = 0; // -840 to 840
};

/// A Julian date in two parts, so that doubles represent it to less than a microsecond. `midnight` is the Julian date
/// of a midnight. `fraction` is the number of days after it, with any sign and size.
struct JulianDate {
    double midnight = 0;
    double fraction = 0;
};

/// Parses a date and time in ISO 8601 with an offset from UTC, for example "2026-06-21T12:00-07:00". Seconds and their
/// decimals are optional, and "Z" means UTC. Returns nullopt for another format or for years outside 1 to 9999.
std::optional<CivilTime> parseCivilTime(std::string_view text);

/// Returns `time` in UTC.
JulianDate julianDate(const CivilTime& time);

/// Returns `date` (UTC) in ISO 8601, as a clock that is `offsetMinutes` ahead of UTC shows it. The time is rounded to
/// the nearest second.
std::string written(const JulianDate& date, int offsetMinutes);

} // namespace gnomon::sun
