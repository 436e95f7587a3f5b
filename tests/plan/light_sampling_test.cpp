// Directions over the light's disc and the sky: what they promise, against plain sums and integrals.
#include "core/random.h"
#include "plan/frame_plan.h"
#include "plan/light_directions.h"
#include "plan/light_sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace gnomon::plan {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;

/// The share of a disc of radius 1 on the far side of a line at `distance` from its middle.
double discShareOutside(double distance) {
    const double x = std::clamp(distance, -1.0, 1.0);
    return (std::acos(x) - x * std::sqrt(1 - x * x)) / kHalfTurn;
}

/// The largest error of the share beyond any line of `bearings` bearings.
double worstShareError(int directions, int bearings) {
    double worst = 0;
    std::vector<double> places(static_cast<std::size_t>(directions));
    for (int bearing = 0; bearing < bearings; ++bearing) {
        const double turn = 2 * kHalfTurn * bearing / bearings;
        for (int i = 0; i < directions; ++i) {
            const glm::dvec2 point = discPoint(i, directions);
            places[static_cast<std::size_t>(i)] = point.x * std::cos(turn) + point.y * std::sin(turn);
        }
        std::sort(places.begin(), places.end());
        for (std::size_t i = 0; i < places.size(); ++i) {
            const double before = 1 - discShareOutside(places[i]);
            const auto share = [&](std::size_t count) { return static_cast<double>(count) / directions; };
            worst = std::max({worst, std::abs(before - share(i)), std::abs(before - share(i + 1))});
        }
    }
    return worst;
}

/// What lies beyond `place` of places along a line, summed: of each its distance.
double reachOutside(const std::vector<double>& places, double place) {
    double sum = 0;
    for (const double each : places)
        sum += std::max(each - place, 0.0);
    return sum / static_cast<double>(places.size());
}

/// The same of a disc of radius 1.
double discReachOutside(double place) {
    const double height = std::sqrt(1 - place * place);
    return 2 / (3 * kHalfTurn) * height * height * height - place * discShareOutside(place);
}

/// The most that the first of all points are off beside a penumbra narrower than a pixel, whose edge lies along its
/// border: the mean over the pixel is that reach in units of half the width, wherever the border cuts the penumbra.
double worstOfFirst(int first, int all) {
    double worst = 0;
    std::vector<double> places(static_cast<std::size_t>(first));
    for (int bearing = 0; bearing < 60; ++bearing) {
        const double turn = 2 * kHalfTurn * bearing / 60;
        for (int i = 0; i < first; ++i) {
            const glm::dvec2 point = discPoint(i, all);
            places[static_cast<std::size_t>(i)] = point.x * std::cos(turn) + point.y * std::sin(turn);
        }
        for (int step = -20; step <= 20; ++step)
            worst = std::max(worst, std::abs(reachOutside(places, step / 20.0) - discReachOutside(step / 20.0)) / 2);
    }
    return worst;
}

TEST(DiscPoints, TheFirstOnesStandForAllBesideAPenumbraWithinAPixel) {
    EXPECT_NEAR(discReachOutside(0), 2 / (3 * kHalfTurn), 1e-12);
    int fewer = 0;
    for (const DiscSampling& sampling : kDiscSamplings) {
        EXPECT_EQ(minFirstPoints(sampling.directions), sampling.first);
        for (const int more : {0, 1, 2, 5, 9, 16, 32, 64}) {
            const int first = std::min(sampling.first + more, sampling.directions);
            EXPECT_LE(worstOfFirst(first, sampling.directions), 0.1061) << first << " of " << sampling.directions;
        }
        fewer += worstOfFirst(sampling.first - 1, sampling.directions) <= 0.1 ? 1 : 0;
    }
    EXPECT_EQ(fewer, 0) << "would do";
    EXPECT_EQ(minFirstPoints(100), 100);
    EXPECT_LE(worstOfFirst(16, 96), 0.017);
    EXPECT_LE(worstOfFirst(16, 384), 0.051);
}

TEST(DiscPoints, KeepTheirPromiseBesideEveryStraightEdge) {
    double errorBefore = 1;
    for (const DiscSampling& sampling : kDiscSamplings) {
        const double error = worstShareError(sampling.directions, sampling.directions > 600 ? 90 : 720);
        EXPECT_LE(error, sampling.error) << sampling.directions;
        if (sampling.directions <= 600) {
            EXPECT_GT(error, 0.9 * sampling.error) << sampling.directions << ": more is promised away than needs be";
        }
        EXPECT_LT(sampling.error, errorBefore);
        errorBefore = sampling.error;
    }
    EXPECT_EQ(directionsFor(0.1), 32);
    EXPECT_EQ(directionsFor(0.05), 96);
    EXPECT_EQ(directionsFor(0.02), 384);
    EXPECT_EQ(directionsFor(0), kDiscSamplings.back().directions);
}

TEST(DiscPoints, BeginInTheMiddleAndAreAllApart) {
    for (const int count : {1, 2, 7, 80, 1000}) {
        EXPECT_EQ(discPoint(0, count), glm::dvec2(0));
        std::set<std::pair<double, double>> all;
        for (int i = 0; i < count; ++i) {
            const glm::dvec2 point = discPoint(i, count);
            EXPECT_LE(glm::length(point), 1);
            all.insert({point.x, point.y});
        }
        EXPECT_EQ(all.size(), static_cast<std::size_t>(count));
    }
    const double angle = 0.3;
    for (const glm::dvec3& middle : {glm::dvec3(0, 2, 0), glm::dvec3(-1, 0, 0), glm::dvec3(3, 1, -2)}) {
        EXPECT_NEAR(glm::length(towardsDisc(middle, angle, {0, 0}) - glm::normalize(middle)), 0, 1e-15);
        for (const glm::dvec2& rim : {glm::dvec2(1, 0), glm::dvec2(0, -1), glm::dvec2(0.6, 0.8)}) {
            const glm::dvec3 towards = towardsDisc(middle, angle, rim);
            EXPECT_NEAR(glm::length(towards), 1, 1e-15);
            EXPECT_NEAR(std::acos(glm::dot(towards, glm::normalize(middle))), angle / 2, 1e-12);
        }
    }
}

// The mean over a pixel of what a point light leaves out, at its worst: an integral, along the edge's profile.
TEST(MinPenumbra, IsTheWidthAtWhichAPointLightIsOffByTheError) {
    for (const double error : {0.02, 0.05, 0.1}) {
        const double width = minPenumbra(error);
        double worst = 0;
        constexpr int kSteps = 400;
        for (int shift = -kSteps; shift <= kSteps; ++shift) {
            double difference = 0;
            for (int i = 0; i < kSteps; ++i) {
                const double place = (i + 0.5) / kSteps - 0.5 + 0.75 * shift / kSteps; // pixels from the edge
                difference += (discShareOutside(-place / (width / 2)) - (place > 0 ? 1 : 0)) / kSteps;
            }
            worst = std::max(worst, std::abs(difference));
        }
        EXPECT_NEAR(worst, error, 0.6 / kSteps);
    }
}

struct SeenSlope {
    glm::dvec3 normal, wall;
};

/// The light of a surface of that normal that sees the sky on one side of a plane, 1 being all of a level one.
double skyLightOf(const SeenSlope& slope, int parts, SkyModel model) {
    double sum = 0;
    for (int i = 0; i < parts; ++i) {
        const SkyPart part = skyPart(i, parts, model, {0, 2, 0});
        if (glm::dot(part.direction, slope.wall) > 0)
            sum += part.weight * std::max(glm::dot(part.direction, slope.normal), 0.0);
    }
    return sum / parts;
}

// What more edges than one do: a shadow that fills just a pixel, all of whose four edges lie along its sides, is off by
// four times as much as one along a side, and no bound of one edge holds for it. Of each point of the disc the shadow
// is the same square, moved.
TEST(MinPenumbra, IsOfOneEdgeAndFourAroundAPixelAddUp) {
    constexpr double kError = 0.05;
    const double half = minPenumbra(kError) / 2;
    constexpr int kPoints = 4096;
    double one = 0;
    double two = 0;
    double four = 0;
    for (int i = 0; i < kPoints; ++i) {
        const glm::dvec2 moved = half * discPoint(i, kPoints);
        const double x = std::abs(moved.x);
        const double y = std::abs(moved.y);
        one += std::max(moved.x, 0.0) / kPoints; // the shadow of a half-plane that ends where the pixel does
        two += x / kPoints;                      // that of a strip as wide as the pixel
        four += (1 - (1 - x) * (1 - y)) / kPoints;
    }
    EXPECT_NEAR(one, kError, 1e-3);
    EXPECT_NEAR(two, 2 * kError, 2e-3);
    EXPECT_NEAR(four, 4 * kError, 0.1 * 4 * kError); // what their corners share goes with the width's square
    EXPECT_LT(four, 4 * kError);
    EXPECT_GT(four, 3.5 * kError);
}

TEST(SkyParts, AreAsBrightAsTheirSky) {
    for (const SkyModel model : {SkyModel::Uniform, SkyModel::Overcast}) {
        EXPECT_NEAR(skyLightOf({{0, 1, 0}, {0, 1, 0}}, 4096, model), 1, 1e-5);
        for (int i = 0; i < 64; ++i) {
            const SkyPart part = skyPart(i, 64, model, {0, 0, 3});
            EXPECT_NEAR(glm::length(part.direction), 1, 1e-14);
            EXPECT_GT(part.direction.z, 0);
        }
    }
    // A roof of 60 degrees sees (1 + cos 60) / 2 of a uniform sky; a wall, of an overcast one, 0.396 (3/14 + 4 / (7
    // pi)).
    EXPECT_NEAR(skyLightOf({{std::sqrt(0.75), 0.5, 0}, {0, 1, 0}}, 4096, SkyModel::Uniform), 0.75, 0.002);
    EXPECT_NEAR(skyLightOf({{1, 0, 0}, {0, 1, 0}}, 4096, SkyModel::Overcast), 3.0 / 14 + 4 / (7 * kHalfTurn), 0.002);
    const SkyPart top = skyPart(0, 4096, SkyModel::Overcast, {0, 1, 0});
    EXPECT_NEAR(top.weight / (2 * 3.0 / 7), 3, 0.01) << "the zenith is three times as bright as the horizon";
}

TEST(SkyParts, KeepTheirPromiseBesideEveryWall) {
    Random random(5);
    const auto direction = [&] {
        return glm::normalize(glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
    };
    for (int round = 0; round < 60; ++round) {
        SeenSlope slope{direction(), direction()};
        slope.normal.y = std::abs(slope.normal.y);
        if (round % 3 == 0) slope.normal = {0, 1, 0};
        for (const SkyModel model : {SkyModel::Uniform, SkyModel::Overcast}) {
            const double light = skyLightOf(slope, 20000, model);
            for (const int parts : {16, 64, 256})
                EXPECT_NEAR(skyLightOf(slope, parts, model), light, skyError(parts, model)) << parts;
        }
    }
}

FramePlan lightAskedFor(double angle, ShadowMode shadows = ShadowMode::Exact, Shading shading = Shading::Lit) {
    FramePlan plan;
    plan.view.sunAngleRadians = angle;
    plan.quality.shadows = shadows;
    plan.quality.look.shading = shading;
    plan.quality.sky.directions = 64;
    return plan;
}

TEST(LightSampling, IsPlannedWhereItShowsAndElseSaysWhyNot) {
    FramePlan plan = lightAskedFor(0);
    planPenumbra(plan, {9, {}, {}});
    EXPECT_EQ(lightFrames(plan), 1);
    EXPECT_TRUE(plan.omitted.empty()) << "nobody asked";
    plan = lightAskedFor(0.01);
    planPenumbra(plan, {9, {}, {}});
    planSky(plan, true);
    EXPECT_EQ(plan.penumbra.directions, 96);
    EXPECT_EQ(plan.sky.directions, 64);
    EXPECT_EQ(lightFrames(plan), 96);
    skipLightSampling(plan);
    EXPECT_EQ(lightFrames(plan), 1);
    EXPECT_EQ(plan.omitted.size(), 2U);
    plan = lightAskedFor(0.01);
    planPenumbra(plan, {0.47, {}, {}});
    planSky(plan, false);
    EXPECT_EQ(lightFrames(plan), 1);
    ASSERT_EQ(plan.omitted.size(), 2U);
    EXPECT_EQ(plan.omitted[0].reason, SkipReason::NarrowPenumbrae);
    EXPECT_NEAR(plan.omitted[0].pixels, 0.471, 0.001);
    EXPECT_EQ(plan.omitted[1].reason, SkipReason::NothingHidesTheSky);
    for (const auto& [shadows, shading, reason] :
         {std::tuple(ShadowMode::Off, Shading::Lit, SkipReason::NoShadows),
          std::tuple(ShadowMode::Exact, Shading::Headlight, SkipReason::NoSun)}) {
        plan = lightAskedFor(0.01, shadows, shading);
        planPenumbra(plan, {9, {}, {}});
        planSky(plan, true);
        EXPECT_EQ(lightFrames(plan), 1);
        ASSERT_EQ(plan.omitted.size(), 2U);
        EXPECT_EQ(plan.omitted[0].reason, reason);
        EXPECT_EQ(plan.omitted[1].reason, reason);
    }
}

TEST(LightSampling, TakesTheTilesWhosePenumbraeAreAsWideAsShows) {
    FramePlan plan = lightAskedFor(0.01);
    const std::vector<double> byTile = {9, 0.1, 0.47, 0.48};
    const PenumbraBound bound{9, {64, 33}, byTile};
    planPenumbra(plan, bound);
    ASSERT_TRUE(plan.penumbra.tiles);
    EXPECT_EQ(plan.penumbra.tiles->tiles, bound.tiles);
    EXPECT_EQ(plan.penumbra.tiles->wanted, (std::vector<bool>{true, false, false, true}));
    EXPECT_TRUE(plan.penumbra.tiles->holdsAny(31, 31, 32, 33));
    EXPECT_FALSE(plan.penumbra.tiles->holdsAny(32, 0, 64, 32));
    skipLightSampling(plan);
    EXPECT_FALSE(plan.penumbra.tiles);
    const std::vector<double> wide(4, 0.48);
    planPenumbra(plan, {0.48, {64, 33}, wide});
    EXPECT_EQ(plan.penumbra.directions, 96);
    EXPECT_FALSE(plan.penumbra.tiles) << "all of them";
}

} // namespace
} // namespace gnomon::plan
