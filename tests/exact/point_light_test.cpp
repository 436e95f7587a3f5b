// Exact shadows of a point light: the predicate against a second one that shares no formula with it, the fast path
// against the loop over all samples and triangles, and where the light lies on what it shines on.
#include "exact/point_predicate.h"
#include "exact/pyramid_clip.h"
#include "tests/exact/plain_intersection.h"
#include "tests/exact/scenes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::exact {
namespace {

constexpr std::int64_t kPointScale = std::int64_t{1} << kWeightBits;

bool isSameHit(const RayHit& a, const RayHit& b) {
    return a.kind == b.kind && a.isOnEdge == b.isOnEdge;
}

TEST(PointLight, PredicateEqualsCramersRuleWhereTiesAbound) {
    RandomWholes random(1);
    std::array<int, 3> hits{};
    int ties = 0;
    for (int i = 0; i < 40000; ++i) {
        const Corners caster{random.point(0, 6), random.point(0, 6), random.point(0, 6)};
        const glm::i64vec3 light = random.point(-2, 8);
        const glm::i64vec3 point =
            random.whole(0, 1) == 0 ? random.point(0, 24) * (kPointScale / 4) : random.point(0, 6) * kPointScale;
        if (point == light * kPointScale) continue;
        const RayHit hit = intersectTowards(caster, light, point);
        ASSERT_TRUE(isSameHit(hit, plainPointHit(caster, light, point))) << i;
        ++hits[static_cast<std::size_t>(hit.kind)];
        ties += hit.isOnEdge ? 1 : 0;
    }
    EXPECT_GT(hits[1], 300);
    EXPECT_GT(hits[2], 100);
    EXPECT_GT(ties, 60);
}

TEST(PointLight, PredicateHoldsTheLargestCoordinates) {
    RandomWholes random(2);
    constexpr std::int64_t kMaxCoordinate = (std::int64_t{1} << 31) - 1;
    constexpr std::int64_t kMaxLight = (std::int64_t{1} << kPointLightBits) - 1;
    // Corners of the cube of all coordinates, or anything within.
    const auto somewhere = [&](std::int64_t max) {
        glm::i64vec3 p;
        for (int axis = 0; axis < 3; ++axis)
            p[axis] = random.whole(0, 2) == 0 ? random.whole(-max, max) : random.whole(0, 1) * 2 * max - max;
        return p;
    };
    int hit = 0;
    for (int i = 0; i < 10000; ++i) {
        const Corners caster{somewhere(kMaxCoordinate), somewhere(kMaxCoordinate), somewhere(kMaxCoordinate)};
        const glm::i64vec3 light = somewhere(random.whole(0, 1) == 0 ? kMaxCoordinate : kMaxLight);
        const glm::i64vec3 place = somewhere(kMaxCoordinate);
        const glm::i64vec3 point = place * kPointScale;
        if (place == light) continue; // which, scaled, 64 bits need not hold
        const RayHit found = intersectTowards(caster, light, point);
        ASSERT_TRUE(isSameHit(found, plainPointHit(caster, light, point))) << i;
        hit += found.kind != Hit::None ? 1 : 0;
    }
    EXPECT_GT(hit, 200);
}

/// The faces of an octahedron about `middle`.
std::vector<Corners> octahedron(const glm::i64vec3& middle, std::int64_t radius) {
    std::vector<Corners> faces;
    for (const std::int64_t x : {-radius, radius})
        for (const std::int64_t y : {-radius, radius})
            for (const std::int64_t z : {-radius, radius})
                faces.push_back(
                    {middle + glm::i64vec3(x, 0, 0), middle + glm::i64vec3(0, y, 0), middle + glm::i64vec3(0, 0, z)});
    return faces;
}

TEST(PointLight, NothingLeaksOutOfAClosedShell) {
    RandomWholes random(3);
    int within = 0;
    for (int i = 0; i < 4000; ++i) {
        const std::vector<Corners> shell = octahedron(random.point(-3, 3), 40);
        const glm::i64vec3 middle = shell[0][0] + glm::i64vec3(40, 0, 0);
        // Whole cells, so that ways pass through edges and corners; beyond the tolerance outside.
        const glm::i64vec3 light = middle + random.point(-9, 9);
        const glm::i64vec3 point = middle + random.point(-4, 4) * random.whole(0, 40);
        const glm::i64vec3 size = glm::abs(point - middle);
        const std::int64_t reach = size.x + size.y + size.z;
        if ((reach > 36 && reach < 48) || point == light) continue;
        const auto casts = std::count_if(shell.begin(), shell.end(), [&](const Corners& face) {
            return intersectTowards(face, light, point * kPointScale).kind == Hit::Ahead;
        });
        EXPECT_EQ(casts, reach < 40 ? 0 : 1) << i;
        within += reach < 40 ? 1 : 0;
    }
    EXPECT_GT(within, 300);
}

TEST(PointLight, WhatHoldsTheLightCastsNothing) {
    const Corners level{glm::i64vec3(0, 0, 8), glm::i64vec3(9, 0, 8), glm::i64vec3(0, 9, 8)};
    const glm::i64vec3 below(2 * kPointScale + 5, 2 * kPointScale + 3, 0);
    EXPECT_EQ(intersectTowards(level, {2, 2, 20}, below).kind, Hit::Ahead);
    EXPECT_EQ(intersectTowards(level, {2, 2, 9}, below).kind, Hit::Ahead);
    EXPECT_EQ(intersectTowards(level, {2, 2, 8}, below).kind, Hit::None) << "within it";
    EXPECT_EQ(intersectTowards(level, {0, 0, 8}, below).kind, Hit::None) << "at a corner of it";
    EXPECT_EQ(intersectTowards(level, {90, 2, 8}, below).kind, Hit::None) << "in its plane";
    EXPECT_EQ(intersectTowards(level, {2, 2, 7}, below).kind, Hit::None) << "it lies beyond the light";
    EXPECT_EQ(intersectTowards(level, {2, 2, -20}, below).kind, Hit::None) << "it lies behind the point";
}

/// Triangles of all shapes on whole cells within `max` of `middle`; some have a corner at `light`, or its plane.
std::vector<Corners> trianglesAbout(RandomWholes& random, int count, const glm::i64vec3& light, std::int64_t max) {
    std::vector<Corners> triangles;
    while (static_cast<int>(triangles.size()) < count) {
        Corners corners{random.point(-max, max), random.point(-max, max), random.point(-max, max)};
        const std::int64_t kind = random.whole(0, 9);
        if (kind == 0) corners[0] = light;
        if (kind == 1) corners[2] = corners[0] + corners[1] - light;
        if (kind == 2 && !triangles.empty()) corners = {triangles.back()[1], triangles.back()[0], corners[2]};
        if (kind == 3 && !triangles.empty()) corners = triangles.back();
        const auto isFar = [&](const glm::i64vec3& p) {
            return glm::any(glm::greaterThan(glm::abs(p), glm::i64vec3(max)));
        };
        if (!std::any_of(corners.begin(), corners.end(), isFar)) triangles.push_back(corners);
    }
    return triangles;
}

void addPointsOn(RandomWholes& random, Scene& scene, int count, bool isTied) {
    for (int i = 0; i < count; ++i) {
        ScenePoint point;
        point.triangle = scene.names()[static_cast<std::size_t>(
            random.whole(0, static_cast<std::int64_t>(scene.names().size()) - 1))];
        point.second = isTied ? 0.25F * static_cast<float>(random.whole(1, 2)) : static_cast<float>(random.real(0, 1));
        point.third = isTied ? 0.25F : static_cast<float>(random.real(0, 1 - point.second));
        scene.points.push_back(point);
    }
}

TEST(PyramidClip, HoldsAllThatIsSeenOfATriangleAndNotMuchMore) {
    RandomWholes random(8);
    int seen = 0;
    int unseen = 0;
    int whole = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        constexpr double kSide = 16;
        constexpr double kMinW = 1e-3;
        std::array<glm::dvec3, 3> corners{};
        for (glm::dvec3& corner : corners)
            corner = glm::dvec3(random.real(-40, 40), random.real(-40, 40), random.real(-3, 3));
        const std::optional<CellReach> reach = reachOfPyramid(corners, kSide, 0.01, kMinW);
        glm::dvec2 min(kSide);
        glm::dvec2 max(0);
        bool isSeen = false;
        for (int i = 0; i < 3000; ++i) {
            const double second = std::sqrt(random.real(0, 1));
            const double third = random.real(0, second);
            const glm::dvec3 p = corners[0] + second * (corners[1] - corners[0]) + third * (corners[2] - corners[1]);
            if (p.z <= kMinW || p.x < 0 || p.y < 0 || p.x > kSide * p.z || p.y > kSide * p.z) continue;
            isSeen = true;
            min = glm::min(min, glm::dvec2(p) / p.z);
            max = glm::max(max, glm::dvec2(p) / p.z);
        }
        unseen += reach ? 0 : 1;
        if (!isSeen) continue;
        ++seen;
        ASSERT_TRUE(reach) << trial;
        EXPECT_TRUE(reach->minX <= min.x && reach->minY <= min.y) << trial;
        EXPECT_TRUE(reach->maxX >= max.x && reach->maxY >= max.y) << trial;
        whole += reach->minX <= 0 && reach->maxX >= kSide && reach->minY <= 0 && reach->maxY >= kSide ? 1 : 0;
    }
    EXPECT_GT(seen, 300);
    EXPECT_GT(unseen, 300);
    EXPECT_LT(whole, seen / 4);
    // Through the light itself: who knows.
    const std::array<glm::dvec3, 3> through{glm::dvec3(-1, -1, -1), glm::dvec3(1, 1, 1), glm::dvec3(-1, 1, 0)};
    EXPECT_EQ(reachOfPyramid(through, 16, 0.01, 1e-3)->maxX, 16);
}

TEST(PointLight, EqualsThePlainLoop) {
    std::uint64_t withinTolerance = 0;
    std::uint64_t dark = 0;
    std::uint64_t lit = 0;
    for (std::uint64_t seed = 0; seed < 120; ++seed) {
        SCOPED_TRACE(seed);
        RandomWholes random(seed);
        // Small ones tie; large ones are far from the light or hold it among them.
        const bool isSmall = seed % 2 == 0;
        const std::int64_t max = isSmall ? random.whole(4, 40) : std::int64_t{1} << random.whole(6, 30);
        glm::i64vec3 light = random.point(-max, max);
        if (seed % 5 == 0) light *= std::int64_t{1} << random.whole(1, 21);
        Scene scene;
        scene.originCell = glm::uvec3(0x80000000U);
        for (std::int64_t clusters = random.whole(1, 4); clusters > 0; --clusters)
            scene.add(trianglesAbout(
                random, static_cast<int>(random.whole(1, 20)), seed % 5 == 0 ? glm::i64vec3(0) : light, max));
        addPointsOn(random, scene, 150, isSmall);
        const SampleSpace space = pointSpace(light, glm::dvec3(random.point(-max, max)) + 0.5);
        const auto found = expectSameAsPlain(scene, space, {}, static_cast<int>(random.whole(4, 64)));
        withinTolerance += found.withinTolerance;
        dark += found.dark;
        lit += found.samples - found.dark;
    }
    EXPECT_GT(withinTolerance, 100U);
    EXPECT_GT(dark, 1000U);
    EXPECT_GT(lit, 1000U);
}

TEST(PointLight, ManySamplesNearTheLightAndFewIntegers) {
    std::uint64_t tests = 0;
    std::uint64_t decisions = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        RandomWholes random(seed + 500);
        constexpr std::int64_t kMaxCoordinate = 100000;
        const glm::i64vec3 light = random.point(-kMaxCoordinate / 2, kMaxCoordinate / 2);
        Scene scene;
        for (int clusters = 0; clusters < 3; ++clusters) {
            std::vector<Corners> triangles;
            for (int i = 0; i < 40; ++i) {
                const glm::i64vec3 at = light + random.point(-9, 9) * (std::int64_t{1} << random.whole(0, 12));
                const std::int64_t size = random.whole(0, 1) == 0 ? 60 : 20000;
                triangles.push_back({at, at + random.point(-size, size), at + random.point(-size, size)});
            }
            scene.add(triangles);
        }
        addPointsOn(random, scene, 400, false);
        const auto found = expectSameAsPlain(
            scene, pointSpace(light, glm::dvec3(random.point(-kMaxCoordinate, kMaxCoordinate))), {}, 32);
        tests += found.counts.sampleTests;
        decisions += found.counts.exactDecisions;
    }
    EXPECT_GT(tests, 8000U);
    EXPECT_LT(decisions, tests / 100);
}

// Doubled triangles, and a wall of pieces over one another: all that a sample lies in the plane of covers it at the
// distance 0. What lies a few cells beside is left to the integers.
TEST(PointLight, WhatSharesAPlaneNeedsNoIntegers) {
    std::uint64_t tests = 0;
    std::uint64_t decisions = 0;
    std::uint64_t dark = 0;
    std::uint64_t withinTolerance = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        RandomWholes random(seed + 900);
        const std::int64_t reach = seed % 4 == 3 ? std::int64_t{1} << 28 : 30000; // the last are too large for doubles
        const glm::i64vec3 light = random.point(-reach, reach);
        Scene scene;
        for (int walls = 0; walls < 6; ++walls) {
            glm::i64vec3 across = random.point(-9, 9);
            glm::i64vec3 along = random.point(-9, 9);
            const glm::length_t flat = walls % 4; // a floor, or a wall aslant
            if (flat < 3) across[flat] = along[flat] = 0;
            const glm::i64vec3 at = random.point(-reach, reach);
            const auto onWall = [&] {
                return at + random.whole(-reach / 9, reach / 9) * across + random.whole(-reach / 9, reach / 9) * along;
            };
            std::vector<Corners> triangles;
            for (int i = 0; i < 10; ++i) {
                triangles.push_back({onWall(), onWall(), onWall()});
                glm::i64vec3 beside(0); // of some a few cells: it touches, or casts
                beside[flat % 3] = seed % 4 == 2 ? random.whole(-4, 4) : 0;
                const Corners first = triangles.back();
                triangles.push_back({first[1] + beside, first[0] + beside, first[2] + beside});
            }
            scene.add(triangles);
        }
        addPointsOn(random, scene, 400, false);
        const auto found =
            expectSameAsPlain(scene, pointSpace(light, glm::dvec3(random.point(-reach, reach)) + 0.5), {}, 32);
        dark += found.dark;
        withinTolerance += found.withinTolerance;
        if (seed % 4 >= 2) continue;
        tests += found.counts.sampleTests;
        decisions += found.counts.exactDecisions;
    }
    EXPECT_GT(tests, 10000U);
    EXPECT_GT(dark, 100U);
    EXPECT_GT(withinTolerance, 5U);
    EXPECT_LE(decisions, tests / 1000);
}

TEST(PointLight, FarAwayIsADirection) {
    // At 2^20 times the scene's size ways differ by 2^-20 in direction; verdicts that do not hang on that are the same.
    RandomWholes random(9);
    std::size_t same = 0;
    std::size_t all = 0;
    for (int trial = 0; trial < 20; ++trial) {
        constexpr std::int64_t kMaxCoordinate = 1 << 20;
        Scene scene;
        scene.originCell = glm::uvec3(0x80000000U);
        scene.add(trianglesAbout(random, 20, glm::i64vec3(0), kMaxCoordinate));
        addPointsOn(random, scene, 300, false);
        const IntegerLight direction =
            roundedLight(glm::dvec3(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)));
        const glm::dvec3 eye(random.point(-kMaxCoordinate, kMaxCoordinate));
        const auto verdicts = [&](const SampleSpace& space) {
            SampleList samples;
            fill(samples, scene, space);
            const std::vector<std::uint8_t> statuses = plainStatuses(samples, scene);
            std::vector<int> byPoint(scene.points.size(), -1);
            for (std::size_t i = 0; i < statuses.size(); ++i)
                byPoint[samples.pixel[i]] = isDark(statuses[i]) ? 1 : 0;
            return byPoint;
        };
        SampleSpace far = spaceOf(direction, eye);
        for (ScenePoint& point : scene.points)
            point.tolerance = 1;
        const std::vector<int> byDirection = verdicts(far);
        const std::vector<int> byPoint = verdicts(pointSpace(direction.direction * (std::int64_t{1} << 17), eye));
        for (std::size_t i = 0; i < byPoint.size(); ++i)
            same += byPoint[i] == byDirection[i] ? 1U : 0U;
        all += byPoint.size();
    }
    EXPECT_GE(same + 2, all);
}

} // namespace
} // namespace gnomon::exact
