// Exact shadows against the loop over all samples and triangles: the same verdicts from every grid, warp, instruction
// set and number of threads.
#include "exact/caster_context.h"
#include "exact/caster_kernel.h"
#include "exact/exact_shadows.h"
#include "tests/exact/scenes.h"
#include "tests/support/rounding.h"
#include "tests/support/sanitizers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::exact {
namespace {

constexpr std::int64_t kTieLight = std::int64_t{1} << 22;

/// A homography of the light plane: none, a mild warp, a strong one, or one whose centre lies among coordinates up to
/// `reach`.
glm::dmat3 somePlane(RandomWholes& random, double reach) {
    const std::int64_t kind = random.whole(0, 3);
    if (kind == 0) return glm::dmat3(1);
    const double angle = random.real(0, 6.3);
    const double turn = random.real(0, 6.3);
    const glm::dvec2 towards(std::cos(angle), std::sin(angle));
    const double strength = kind == 1 ? 0.3 : kind == 2 ? 0.95 : random.real(1, 4);
    const double scale = std::exp2(random.real(-20, 20)) / reach;
    const double offset = random.real(-9, 9);
    // Columns are u, v and 1; w is 1 + strength (towards . (u, v)) / (2 reach).
    const glm::dvec2 w = towards * (strength / (2 * reach));
    return {
        {scale * std::cos(turn), scale * std::sin(turn), w.x},
        {-scale * std::sin(turn), scale * std::cos(turn), w.y},
        {offset, -offset, 1}};
}

std::vector<glm::dmat3> somePlanes(RandomWholes& random, std::size_t count, double reach) {
    std::vector<glm::dmat3> planes;
    for (std::size_t i = 0; i < count; ++i)
        planes.push_back(somePlane(random, reach));
    return planes;
}

/// Weights at which points lie on whole and half cells and their rays meet corners and edges, or any.
void somePlace(RandomWholes& random, bool isTied, ScenePoint& point) {
    if (isTied) {
        point.second = static_cast<float>(random.whole(1, 2)) / 4;
        point.third = static_cast<float>(random.whole(1, 2)) / 4 - (point.second > 0.25F ? 0.25F : 0.F);
        point.third = std::max(point.third, 0.25F);
        return;
    }
    point.second = static_cast<float>(random.real(0, 1));
    point.third = static_cast<float>(random.real(0, 1 - point.second));
}

void addPoints(RandomWholes& random, Scene& scene, int count, int maps, bool isTied) {
    for (int i = 0; i < count; ++i) {
        ScenePoint point;
        point.triangle = scene.names()[static_cast<std::size_t>(
            random.whole(0, static_cast<std::int64_t>(scene.names().size()) - 1))];
        somePlace(random, isTied, point);
        point.map = static_cast<std::int32_t>(random.whole(-1, maps - 1));
        point.tolerance = static_cast<std::uint32_t>(std::max<std::int64_t>(0, random.whole(-2, 3)));
        scene.points.push_back(point);
    }
}

IntegerLight someTieLight(RandomWholes& random) {
    glm::i64vec3 direction(0);
    while (direction == glm::i64vec3(0))
        direction = random.point(-3, 3);
    return {direction * kTieLight};
}

TEST(ExactShadows, EqualThePlainLoopWhereTiesAbound) {
    std::uint64_t withinTolerance = 0;
    std::uint64_t dark = 0;
    std::uint64_t lit = 0;
    for (std::uint64_t seed = 0; seed < 150; ++seed) {
        SCOPED_TRACE(seed);
        RandomWholes random(seed);
        Scene scene;
        for (std::int64_t clusters = random.whole(1, 4); clusters > 0; --clusters)
            scene.add(someTriangles(random, static_cast<int>(random.whole(1, 20)), 6));
        const int maps = static_cast<int>(random.whole(1, 3));
        addPoints(random, scene, 150, maps, true);
        const SampleSpace space = spaceOf(someTieLight(random), glm::dvec3(random.point(-20, 20)) + 0.5, maps);
        const int side = static_cast<int>(random.whole(4, 64));
        const auto found = expectSameAsPlain(scene, space, somePlanes(random, static_cast<std::size_t>(maps), 6), side);
        withinTolerance += found.withinTolerance;
        dark += found.dark;
        lit += found.samples - found.dark;
    }
    EXPECT_GT(withinTolerance, 100U);
    EXPECT_GT(dark, 1000U);
    EXPECT_GT(lit, 1000U);
}

/// The cells that samples fall into hang on rounding, and no verdict does.
TEST(ExactShadows, EqualThePlainLoopInEveryRoundingMode) {
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
            SCOPED_TRACE(testing::Message() << "rounding " << mode << ", seed " << seed);
            RandomWholes random(seed + 5000);
            Scene scene;
            for (int clusters = 0; clusters < 3; ++clusters)
                scene.add(someTriangles(random, 15, seed % 2 == 0 ? 6 : 1 << 20));
            addPoints(random, scene, 150, 2, seed % 2 == 0);
            const SampleSpace space = spaceOf(someTieLight(random), glm::dvec3(random.point(-20, 20)) + 0.5, 2);
            const std::vector<glm::dmat3> planes = somePlanes(random, 2, seed % 2 == 0 ? 6 : 1 << 20);
            const tests::RoundingMode rounding(mode);
            expectSameAsPlain(scene, space, planes, 32);
        }
}

TEST(ExactShadows, EqualThePlainLoopAtAnyLightAndSize) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        RandomWholes random(seed + 1000);
        Scene scene;
        const std::int64_t max = std::int64_t{1} << random.whole(3, 30);
        for (int clusters = 0; clusters < 3; ++clusters)
            scene.add(someTriangles(random, 20, max));
        const int maps = static_cast<int>(random.whole(1, 3));
        addPoints(random, scene, 200, maps, false);
        const glm::dvec3 towards(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
        const SampleSpace space = spaceOf(roundedLight(towards), glm::dvec3(random.point(-max, max)), maps);
        const auto reach = static_cast<double>(max);
        expectSameAsPlain(
            scene,
            space,
            somePlanes(random, static_cast<std::size_t>(maps), reach),
            static_cast<int>(random.whole(4, 64)));
    }
}

/// A warp whose w falls to 2^-18 at the first of the samples, and is 1 some cells on: around there a rounding of (u, v)
/// spans cells.
glm::dmat3 planeThroughSamples(const SampleList& samples) {
    const double min = *std::min_element(samples.u.begin(), samples.u.begin() + static_cast<int>(samples.size()));
    return {{1, 0, 1.0 / 32}, {0, 1, 0}, {0, 0, 0x1p-18 - min / 32}};
}

/// Points on whole cells of one small triangle, and casters each of which has a corner straight before one of them.
Scene sceneOfCornersOnRays(RandomWholes& random, const IntegerLight& light, std::int64_t max) {
    Scene scene;
    const glm::i64vec3 at = random.point(-max, max) / random.whole(1, max);
    const glm::i64vec3 b = random.point(-9, 9) * 4L;
    const glm::i64vec3 c = random.point(-9, 9) * 4L;
    std::vector<Corners> triangles{{at, at + b, at + c}};
    for (int i = 0; i < 4; ++i) {
        const glm::i64vec3 weights = i == 0   ? glm::i64vec3(1, 1, 0)
                                     : i == 1 ? glm::i64vec3(2, 1, 0)
                                              : glm::i64vec3(1, 2, 0);
        scene.points.push_back({0, static_cast<float>(weights.x) / 4, static_cast<float>(weights.y) / 4, 0, 0});
        const glm::i64vec3 corner = at + (b * weights.x + c * weights.y) / 4L + light.direction * random.whole(1, 32);
        triangles.push_back({corner, corner + random.point(-max, max), corner + random.point(-max, max)});
    }
    scene.add(triangles);
    scene.points.resize(static_cast<std::size_t>(random.whole(1, 4)));
    return scene;
}

TEST(ExactShadows, CellsAreNeverSmallerThanARounding) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    std::uint64_t withinTolerance = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE(seed);
        RandomWholes random(seed + 2000);
        const IntegerLight light = roundedLight(glm::dvec3(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)));
        const Scene scene = sceneOfCornersOnRays(random, light, std::int64_t{1} << 28);
        SampleSpace space = spaceOf(light, glm::dvec3(scene.corners(0)[0]) + glm::dvec3(light.direction) * 0x1p-10);
        SampleList samples;
        fill(samples, scene, space);
        if (samples.size() == 0) continue;
        for (const glm::dmat3& plane : {glm::dmat3(1), planeThroughSamples(samples)})
            withinTolerance += expectSameAsPlain(scene, space, {plane}, 64).withinTolerance;
    }
    EXPECT_GT(withinTolerance, 100U);
}

TEST(ExactShadows, AsFarAsTheToleranceStillTouches) {
    constexpr float kOne = 0x1p-24F;
    for (std::int64_t tolerance = 2; tolerance < 40; ++tolerance) {
        Scene scene;
        // Points of the first triangle lie a few 2^-24 cells above h = 0.
        scene.add(std::vector<Corners>{
            {glm::i64vec3(0, 0, 0), glm::i64vec3(8, 0, 1), glm::i64vec3(0, 8, 0)},
            {glm::i64vec3(-9, -9, tolerance), glm::i64vec3(30, -9, tolerance), glm::i64vec3(-9, 30, tolerance)}});
        for (std::int64_t more = -1; more <= 1; ++more)
            scene.points.push_back(
                {0, static_cast<float>(tolerance + more) * kOne, 0.5F, 0, static_cast<std::uint32_t>(tolerance)});
        const SampleSpace space = spaceOf({{0, 0, (1 << kLightBits) - 1}}, {2, 2, 50});
        const ExactStatistics found = expectSameAsPlain(scene, space, {glm::dmat3(1)}, 4);
        EXPECT_EQ(found.samples, 3U);
        EXPECT_EQ(found.dark, 1U);
        EXPECT_EQ(found.darkWithoutTolerance, 3U);
    }
}

TEST(ExactShadows, SmallGenericScenesNeedFewIntegers) {
    std::uint64_t tests = 0;
    std::uint64_t decisions = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        RandomWholes random(seed + 3000);
        Scene scene;
        for (int clusters = 0; clusters < 3; ++clusters) {
            std::vector<Corners> triangles;
            triangles.reserve(40);
            for (int i = 0; i < 40; ++i)
                triangles.push_back({random.point(0, 5000), random.point(0, 5000), random.point(0, 5000)});
            scene.add(triangles);
        }
        addPoints(random, scene, 300, 1, false);
        for (ScenePoint& point : scene.points)
            point.tolerance = 0;
        const IntegerLight light = roundedLight({random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)});
        const ExactStatistics found =
            expectSameAsPlain(scene, spaceOf(light, glm::dvec3(random.point(0, 5000))), {glm::dmat3(1)}, 8);
        tests += found.counts.sampleTests;
        decisions += found.counts.exactDecisions;
    }
    EXPECT_GT(tests, 20000U);
    EXPECT_LT(decisions, tests / 10000);
}

TEST(ExactShadows, OfNoSampleAskNoTriangle) {
    Scene scene;
    scene.add(std::vector<Corners>{{glm::i64vec3(0), glm::i64vec3(9, 0, 0), glm::i64vec3(0, 9, 0)}});
    const ExactStatistics none = expectSameAsPlain(scene, spaceOf({}, {1, 9, 1}), {glm::dmat3(1)}, 4);
    EXPECT_EQ(none.samples, 0U);
    EXPECT_EQ(none.cells, 16U);
    EXPECT_EQ(none.counts.clustersTested, 0U);
}

TEST(ExactShadows, CountsAddUp) {
    Scene scene;
    scene.add(std::vector<Corners>{
        {glm::i64vec3(0), glm::i64vec3(9, 0, 0), glm::i64vec3(0, 9, 0)},
        {glm::i64vec3(-9, -9, 5), glm::i64vec3(30, -9, 5), glm::i64vec3(-9, 30, 5)}});
    scene.add(std::vector<Corners>{{glm::i64vec3(0, 0, -1), glm::i64vec3(9, 0, -1), glm::i64vec3(0, 9, -1)}});
    scene.points = {{0}};
    const SampleSpace space = spaceOf({{0, 0, (1 << kLightBits) - 1}}, {1, 1, 3});
    const ExactStatistics found = expectSameAsPlain(scene, space, {glm::dmat3(1)}, 4);
    EXPECT_EQ(found.samples, 1U);
    EXPECT_EQ(found.dark, 1U);
    EXPECT_EQ(found.withinTolerance, 0U);
    EXPECT_EQ(found.counts.clustersTested, 1U); // the first decides the last sample: the other is not asked
    EXPECT_EQ(found.counts.triangles, 2U);
    EXPECT_EQ(found.counts.trianglesRasterized, 2U);
    EXPECT_EQ(found.counts.sampleTests, 2U);
    EXPECT_EQ(found.counts.exactDecisions, 0U);
}

TEST(ExactShadows, CoplanarTrianglesOfAnySizeCastNothing) {
    RandomWholes random(5);
    for (int i = 0; i < 200; ++i) {
        const std::int64_t max = std::int64_t{1} << random.whole(3, 27);
        const Corners corners{random.point(-max, max), random.point(-max, max), random.point(-max, max)};
        Scene scene;
        scene.add(std::vector<Corners>{
            corners,
            {corners[0] * 3L - corners[1] - corners[2], corners[1], corners[2]},
            {corners[1] * 3L - corners[0] - corners[2], corners[2], corners[0]}});
        for (int k = 0; k < 10; ++k) {
            ScenePoint point;
            somePlace(random, false, point);
            scene.points.push_back(point);
        }
        const IntegerLight light = roundedLight({random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)});
        const glm::dvec3 eye = glm::dvec3(corners[0]) + glm::dvec3(light.direction);
        EXPECT_EQ(expectSameAsPlain(scene, spaceOf(light, eye), {glm::dmat3(1)}, 8).darkWithoutTolerance, 0U);
    }
}

TEST(ExactShadows, ClustersAsLargeAsTheyGet) {
    // A field of hills as one cluster of 242 triangles, points on all of them.
    constexpr int kQuads = 11;
    RandomWholes random(6);
    std::vector<glm::i64vec3> vertices;
    std::vector<raster::Triangle> triangles;
    for (int y = 0; y <= kQuads; ++y)
        for (int x = 0; x <= kQuads; ++x)
            vertices.emplace_back(8 * x, 8 * y, random.whole(0, 24));
    for (int y = 0; y < kQuads; ++y)
        for (int x = 0; x < kQuads; ++x) {
            const auto at = [&](int dx, int dy) { return static_cast<std::uint8_t>((y + dy) * (kQuads + 1) + x + dx); };
            triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
            triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
        }
    Scene scene;
    scene.add(vertices, triangles);
    for (const std::uint32_t name : scene.names())
        for (int k = 0; k < 2; ++k) {
            scene.points.push_back({name});
            somePlace(random, k == 0, scene.points.back());
        }
    for (const glm::i64vec3 direction : {glm::i64vec3(2, 1, 2), glm::i64vec3(-3, 2, 1), glm::i64vec3(1, 0, 1)}) {
        const ExactStatistics found =
            expectSameAsPlain(scene, spaceOf({direction * kTieLight}, {40, 40, 999}), {glm::dmat3(1)}, 32);
        EXPECT_GT(found.dark, 20U);
        EXPECT_GT(found.samples, found.dark + 50);
    }
}

TEST(ExactShadows, SamplesOnTheBordersOfCells) {
    // Cells a cell of the grid wide: x is u + 1. Points whose u is whole, but not in doubles, and before each a corner.
    constexpr std::int64_t kWide = 998;
    const IntegerLight light{glm::i64vec3(3, 0, 11) * (std::int64_t{1} << 20)};
    RandomWholes random(7);
    Scene scene;
    for (int i = 0; i < 300; ++i) {
        const std::int64_t u = i == 0 ? 0 : i == 1 ? kWide : random.whole(1, kWide - 1);
        const std::int64_t v = i == 0 ? 0 : i == 1 ? kWide : random.whole(1, kWide - 1);
        const std::int64_t height = random.whole(-1000, 1000);
        const glm::i64vec3 p(u + 3 * height, v, 11 * height);
        const glm::i64vec3 corner = p + glm::i64vec3(3, 0, 11) * random.whole(1, 99);
        const std::uint32_t name = scene.add(std::vector<Corners>{
            {p - glm::i64vec3(1, 1, 0), p + glm::i64vec3(3, -1, 0), p + glm::i64vec3(-1, 3, 0)},
            {corner, corner + glm::i64vec3(9, -5, 3), corner + glm::i64vec3(9, 5, 3)}});
        scene.points.push_back({name, 0.25F, 0.25F});
    }
    const ExactStatistics found = expectSameAsPlain(scene, spaceOf(light, {0, 0, 1e6}), {glm::dmat3(1)}, 1000);
    EXPECT_EQ(found.samples, 300U);
    EXPECT_GT(found.withinTolerance, 200U);
}

} // namespace
} // namespace gnomon::exact
