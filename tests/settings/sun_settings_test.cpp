#include "settings/sun_settings.h"
#include "sun/sun_period.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::settings {
namespace {

TEST(PlaceCodec, ReadsLatitudeAndLongitudeAndWritesThemBack) {
    const auto found = place().read("39.742476,-105.1786");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->latitude, 39.742476);
    EXPECT_EQ(found->longitude, -105.1786);
    EXPECT_EQ(place().write(*found), "39.742476,-105.1786");
    for (const char* text :
         {"", "1", "1,", ",1", "91,0", "-90.1,0", "0,181", "0,-180.5", "1,2,3", "a,b", "nan,0", "1 ,2"})
        EXPECT_FALSE(place().read(text)) << text;
}

TEST(MomentCodec, WritesWhatItReads) {
    const auto found = moment().read("2026-06-21T12:00+02:00");
    ASSERT_TRUE(found);
    EXPECT_EQ(moment().write(*found), "2026-06-21T12:00:00+02:00");
    EXPECT_FALSE(moment().read("2026-06-21 12:00"));
}

// The shadow of a pole points away from the Sun, whatever is up, and true north turns with --north.
TEST(TowardsSun, StandsWhereTheSkyHasItInEveryWorld) {
    const SunTime asked =
        sunAt({.latitude = 47.4, .longitude = 8.5}, sun::parseCivilTime("2026-06-21T16:00+02:00").value());
    const sun::SunPosition sky = sun::sunPosition(sun::julianDate(asked.time), asked.place, {});
    const double kDegree = 3.14159265358979323846 / 180;

    struct World {
        glm::dvec3 up, north, east;
    };

    for (const World& world :
         {World{{0, 1, 0}, {0, 0, -1}, {1, 0, 0}},
          World{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},
          World{{0, 0, 2}, {0, 1, 0}, {1, 0, 0}}})
        for (const double turned : {0.0, 90.0, -33.0}) {
            const glm::dvec3 light = sun::towardsSun(asked.position, turned, world.up);
            EXPECT_NEAR(glm::length(light), 1, 1e-12);
            const double elevation = std::asin(glm::dot(light, glm::normalize(world.up))) / kDegree;
            EXPECT_NEAR(elevation, sky.elevationRefracted, 1e-9);
            const double azimuth = std::atan2(glm::dot(light, world.east), glm::dot(light, world.north)) / kDegree;
            EXPECT_NEAR(std::remainder(azimuth - sky.azimuth - turned, 360), 0, 1e-9);
        }
}

TEST(TowardsSun, AtNightIsRefusedWithTheHoursOfTheDay) {
    const SunTime night =
        sunAt({.latitude = 47.4, .longitude = 8.5}, sun::parseCivilTime("2026-06-21T02:00+02:00").value());
    try {
        requireSunUp(night);
        FAIL() << "taken";
    } catch (const UsageError& error) {
        EXPECT_EQ(error.option, "--sun");
        EXPECT_NE(error.message.find("it is up from 2026-06-21T05:"), std::string::npos) << error.message;
    }
}

TEST(SkyLightCodec, ReadsDirectionsAndTheirSkyAndWritesThemBack) {
    EXPECT_EQ(skyLight().read("64"), (plan::SkyLight{64, plan::SkyModel::Uniform}));
    EXPECT_EQ(skyLight().read("7,overcast"), (plan::SkyLight{7, plan::SkyModel::Overcast}));
    EXPECT_EQ(skyLight().write({7, plan::SkyModel::Overcast}), "7,overcast");
    EXPECT_EQ(skyLight().write(*skyLight().read("64,uniform")), "64");
    for (const char* text : {"", "-1", "4097", "64,", "64,blue", ",uniform", "64,uniform,overcast", "6.5"})
        EXPECT_FALSE(skyLight().read(text)) << text;
}

// Between its farthest, in July, and its nearest, in January, the Sun's disc is 0.524 to 0.542 degrees wide.
TEST(LightDiameter, IsTheSunsWhereTheSunIsAskedForAndElseAPoint) {
    const double kDegree = 3.14159265358979323846 / 180;
    Settings settings;
    EXPECT_EQ(lightDiameter(settings), 0);
    const auto at = [&](const char* time) {
        settings.sun = sunAt({.latitude = 10, .longitude = 8.5}, sun::parseCivilTime(time).value());
        return lightDiameter(settings) / kDegree;
    };
    EXPECT_NEAR(at("2026-01-03T12:00+01:00"), 0.5422, 0.0003);
    EXPECT_NEAR(at("2026-07-06T12:00+01:00"), 0.5244, 0.0003);
    settings.sunAngleDegrees = 0;
    EXPECT_EQ(lightDiameter(settings), 0);
    settings = {};
    settings.sunAngleDegrees = 2;
    EXPECT_NEAR(lightDiameter(settings), 2 * kDegree, 1e-15);
}

TEST(PointLight, LiesOnTheGridAndIsAsBrightAsTheSunFromAfar) {
    hierarchy::ModelSummary model;
    model.grid = {{-1, 0, 0}, -4};
    model.bounds = {{0, 0, 0}, {12, 16, 15}}; // a diagonal of 25
    Settings settings;
    EXPECT_FALSE(pointLightOf(settings, model));
    settings.lightAt = glm::dvec3(1.03, 5, 2.46);
    EXPECT_EQ(pointLightOf(settings, model)->at, glm::dvec3(1, 5, 2.4375));
    EXPECT_NEAR(pointLightOf(settings, model)->reach, 25.0 / 16, 1e-12);
    settings.lightAt = glm::dvec3(1e7, 5, 2);
    EXPECT_NEAR(pointLightOf(settings, model)->reach / (1e7 - 12), 1, 1e-12);
    settings.lightAt = glm::dvec3(0x1p50, 0, 0);
    EXPECT_THROW(pointLightOf(settings, model), UsageError);
}

} // namespace
} // namespace gnomon::settings
