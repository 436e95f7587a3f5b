// The Sun's place against published figures, against another library, and against its own laws.
#include "sun/civil_time.h"
#include "sun/delta_t.h"
#include "sun/sun_day.h"
#include "sun/sun_position.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <string>

namespace gnomon::sun {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

CivilTime at(const std::string& text) {
    return parseCivilTime(text).value();
}

SunPosition positionAt(const std::string& text, const Place& place, const Air& air = {}) {
    return sunPosition(julianDate(at(text)), place, air);
}

// The angle on the sky between two directions, all in degrees.
double apart(double azimuthA, double elevationA, double azimuthB, double elevationB) {
    const auto direction = [](double azimuth, double elevation) {
        const double level = std::cos(elevation * kDegree);
        return std::array{
            level * std::cos(azimuth * kDegree), level * std::sin(azimuth * kDegree), std::sin(elevation * kDegree)};
    };
    const auto a = direction(azimuthA, elevationA);
    const auto b = direction(azimuthB, elevationB);
    return 2 * std::asin(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) / 2) / kDegree;
}

TEST(CivilTime, IsReadAsIso8601WithAnOffset) {
    const CivilTime time = at("2003-10-17T12:30:30.25-07:00");
    EXPECT_EQ(time.year, 2003);
    EXPECT_EQ(time.month, 10);
    EXPECT_EQ(time.day, 17);
    EXPECT_EQ(time.hour, 12);
    EXPECT_EQ(time.minute, 30);
    EXPECT_EQ(time.second, 30.25);
    EXPECT_EQ(time.offsetMinutes, -420);
    EXPECT_EQ(at("2003-10-17T12:30Z").offsetMinutes, 0);
    EXPECT_EQ(at("2003-10-17T12:30+0545").offsetMinutes, 345);
}

TEST(CivilTime, RefusesWhatIsNoMoment) {
    for (const char* text :
         {"",
          "2003",
          "2003-10-17",
          "2003-10-17T12:30",
          "2003-10-17 12:30Z",
          "2003-13-01T00:00Z",
          "2003-02-29T00:00Z",
          "1900-02-29T00:00Z",
          "2003-10-17T24:00Z",
          "2003-10-17T12:60Z",
          "2003-10-17T12:30:60Z",
          "2003-10-17T12:30:1Z",
          "2003-10-17T12:30:10.Z",
          "2003-10-17T12:30Zx",
          "2003-10-17T12:30+15:00",
          "2003-10-17T12:30+01:60",
          "0000-01-01T00:00Z",
          "-003-10-17T12:30Z",
          "2003-10-17T12:30*01:00"})
        EXPECT_FALSE(parseCivilTime(text)) << text;
    EXPECT_TRUE(parseCivilTime("2000-02-29T00:00Z"));
}

TEST(CivilTime, IsWrittenAsItWasRead) {
    std::mt19937 random(3);
    const auto upTo = [&random](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
    for (int i = 0; i < 2000; ++i) {
        CivilTime time{
            1 + upTo(9998), 1 + upTo(12), 1 + upTo(28), upTo(24), upTo(60), double(upTo(60)), upTo(1681) - 840};
        const std::string text = written(julianDate(time), time.offsetMinutes);
        ASSERT_EQ(written(julianDate(at(text)), time.offsetMinutes), text);
        ASSERT_EQ(at(text).day, time.day) << text;
        ASSERT_EQ(at(text).minute, time.minute) << text;
        ASSERT_EQ(at(text).second, time.second) << text;
    }
    EXPECT_EQ(written(julianDate(at("1999-12-31T23:59:59.7Z")), 0), "2000-01-01T00:00:00+00:00");
}

TEST(DeltaT, IsWhatHistoryAndLeapSecondsSay) {
    // Espenak and Meeus, table 1 of the five millennium canon, rounded to whole seconds there.
    const std::array<std::pair<const char*, double>, 6> rows{
        {{"1600-01-01T00:00Z", 120},
         {"1700-01-01T00:00Z", 9},
         {"1800-01-01T00:00Z", 14},
         {"1900-01-01T00:00Z", -3},
         {"1950-01-01T00:00Z", 29},
         {"1970-01-01T00:00Z", 40.2}}};
    for (const auto& [text, seconds] : rows)
        EXPECT_NEAR(deltaT(julianDate(at(text))), seconds, 1) << text;
    EXPECT_NEAR(deltaT(julianDate(at("1999-06-01T00:00Z"))), 64.184, 1e-9);
    EXPECT_NEAR(deltaT(julianDate(at("2020-06-01T00:00Z"))), 69.184, 1e-9);
    for (int year = 1600; year < 2600; ++year) { // what joins the spans has no step that the Sun would show
        const double before = deltaT(julianDate({year, 12, 31, 0, 0, 0, 0}));
        const double after = deltaT(julianDate({year + 1, 1, 1, 0, 0, 0, 0}));
        EXPECT_NEAR(before, after, 7) << year;
    }
}

// Reda and Andreas (2003), appendix A.5.
TEST(SunPosition, IsThatOfTheExampleOfNrel) {
    const Place boulder{39.742476, -105.1786, 1830.14};
    const SunPosition sun =
        sunPosition(julianDate(at("2003-10-17T12:30:30-07:00")), boulder, {.pressure = 820, .temperature = 11}, 67);
    EXPECT_LT(apart(sun.azimuth, 90 - sun.elevationRefracted, 194.34024, 50.11162), 0.0005);
    const SunDay day = sunDay(at("2003-10-17T12:30:30-07:00"), boulder, {});
    EXPECT_EQ(written(*day.sunrise, -420), "2003-10-17T06:12:44-07:00"); // 6:12:43 there, from another radius
    EXPECT_EQ(written(day.noon, -420), "2003-10-17T11:46:05-07:00");
    EXPECT_EQ(written(*day.sunset, -420), "2003-10-17T17:18:51-07:00");
}

TEST(SunPosition, DiscGrowsAndShrinksWithTheDistance) {
    EXPECT_NEAR(positionAt("2024-01-03T00:00Z", {}).diameter, 0.5421, 0.0002);
    EXPECT_NEAR(positionAt("2024-07-05T00:00Z", {}).diameter, 0.5243, 0.0002);
}

TEST(SunPosition, WithoutPressureHasNoRefractionAndBelowTheHorizonNeither) {
    const Place place{50, 10, 0};
    const SunPosition noon = positionAt("2024-06-01T11:20Z", place, {.pressure = 0, .temperature = 10});
    EXPECT_EQ(noon.elevation, noon.elevationRefracted);
    const SunPosition night = positionAt("2024-06-01T23:20Z", place);
    EXPECT_LT(night.elevation, -10);
    EXPECT_EQ(night.elevation, night.elevationRefracted);
    const SunPosition rise = sunPosition(*sunDay(at("2024-06-01T12:00Z"), place, {}).sunrise, place, {});
    EXPECT_NEAR(rise.elevationRefracted - rise.elevation, 34.0 / 60, 0.09);
}

TEST(SunDay, PolesHaveDayAndNight) {
    for (const double latitude : {90.0, 85.0, -85.0, -90.0}) {
        const Place place{latitude, 25, 0};
        const SunDay june = sunDay(at("2024-06-21T12:00Z"), place, {});
        EXPECT_FALSE(june.sunrise || june.sunset) << latitude;
        EXPECT_EQ(june.upAtNoon, latitude > 0);
        const SunDay december = sunDay(at("2024-12-21T12:00Z"), place, {});
        EXPECT_FALSE(december.sunrise || december.sunset) << latitude;
        EXPECT_EQ(december.upAtNoon, latitude < 0);
    }
}

TEST(SunDay, DateLineKeepsToTheClocksDate) {
    const SunDay fiji = sunDay(at("2024-03-20T01:00+12:00"), {-17.8, 178, 0}, {});
    EXPECT_EQ(written(fiji.noon, 720).substr(0, 13), "2024-03-20T12");
    const SunDay samoa = sunDay(at("2024-03-20T23:00-11:00"), {-14.3, -170.7, 0}, {});
    EXPECT_EQ(written(samoa.noon, -660).substr(0, 13), "2024-03-20T12");
    EXPECT_EQ(written(*samoa.sunrise, -660).substr(0, 13), "2024-03-20T06");
}

// Noon, rise and set against a search that knows nothing of them: the height at every minute of the day.
TEST(SunDay, IsWhatALookAtEveryMinuteFinds) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> fraction(0, 1);
    for (int i = 0; i < 4; ++i) {
        const Place place{fraction(random) * 120 - 60, fraction(random) * 360 - 180, 0};
        CivilTime time{1900 + i * 48, 1 + 3 * i, 10, 12, 0, 0, static_cast<int>(std::round(place.longitude / 15)) * 60};
        const SunDay day = sunDay(time, place, {});
        ASSERT_TRUE(day.sunrise && day.sunset);
        const auto upperEdge = [&place, &day](double minutes) {
            const SunPosition sun =
                sunPosition({day.noon.midnight, day.noon.fraction + minutes / 1440}, place, {.pressure = 0});
            return sun.elevation + sun.diameter / 2 + 34.0 / 60;
        };
        double rise = -720;
        double set = 0;
        const double highest = upperEdge(0);
        double before = upperEdge(-720);
        for (double minute = -719; minute <= 720; ++minute) {
            const double after = upperEdge(minute);
            if (before < 0 && after >= 0) rise = minute;
            if (before >= 0 && after < 0) set = minute;
            before = after;
            ASSERT_LE(after, highest + 0.01) << "noon is the highest, nearly";
        }
        EXPECT_NEAR((day.sunrise->fraction - day.noon.fraction) * 1440, rise, 1.001) << place.latitude;
        EXPECT_NEAR((day.sunset->fraction - day.noon.fraction) * 1440, set, 1.001) << place.latitude;
    }
}

// What a gnomon shows: the shadow's tip on level ground points away from the Sun and is as long as its height's
// cotangent, and over a year noon's elevation swings by twice the tilt of the Earth's axis.
TEST(SunPosition, NoonsOfAYearSwingByTwiceTheTilt) {
    double lowest = 90;
    double highest = 0;
    for (const int month : {6, 12})
        for (int day = 15; day <= 28; ++day) {
            const Place greenwich{51.4778, 0, 0};
            const SunDay found = sunDay({2024, month, day, 12, 0, 0, 0}, greenwich, {});
            const double elevation = sunPosition(found.noon, greenwich, {.pressure = 0}).elevation;
            lowest = std::min(lowest, elevation);
            highest = std::max(highest, elevation);
        }
    EXPECT_NEAR(highest - lowest, 2 * 23.4385, 0.01);
    EXPECT_NEAR((highest + lowest) / 2, 90 - 51.4778, 0.01);
}

// 10,000 times and places from PyEphem (XEphem's libastro, VSOP87), which shares no code with ours.
TEST(SlowSunPosition, IsThatOfAnotherLibrary) {
    if (std::system("/usr/bin/python3 -c 'import ephem' 2>/dev/null") != 0)
        GTEST_SKIP() << "python3-ephem is not installed";
    const std::string command = "/usr/bin/python3 " GNOMON_SOURCE_DIR "/tests/sun/ephem_rows.py 10000";
    const std::unique_ptr<FILE, int (*)(FILE*)> rows(popen(command.c_str(), "r"), pclose);
    double day = 0;
    Place place;
    double azimuth = 0;
    double elevation = 0;
    double refracted = 0;
    int count = 0;
    double worst = 0;
    double worstRefracted = 0;
    while (std::fscanf(
               rows.get(),
               "%lf %lf %lf %lf %lf %lf",
               &day,
               &place.latitude,
               &place.longitude,
               &azimuth,
               &elevation,
               &refracted) == 6) {
        const SunPosition sun = sunPosition({2400000.5, day}, place, {});
        worst = std::max(worst, apart(sun.azimuth, sun.elevation, azimuth, elevation));
        if (elevation > 0) worstRefracted = std::max(worstRefracted, std::abs(sun.elevationRefracted - refracted));
        ++count;
    }
    EXPECT_EQ(count, 10000);
    EXPECT_LT(worst, 0.001);
    EXPECT_LT(worstRefracted, 0.01);
    RecordProperty("worst", std::to_string(worst));
    std::printf("worst %.6f degrees, with refraction %.6f\n", worst, worstRefracted);
}

} // namespace
} // namespace gnomon::sun
