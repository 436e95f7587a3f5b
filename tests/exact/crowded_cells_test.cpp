// Exact shadows of crowds: cells that hold hundreds of samples, which are looked at in boxes of eight.
#include "exact/exact_shadows.h"
#include "tests/exact/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::exact {
namespace {

/// A floor of two triangles, crowded with points in a few places, a sheet of small triangles on it, and what hangs over
/// it: near enough to touch, or anywhere.
Scene someCrowd(RandomWholes& random, std::int64_t max) {
    Scene scene;
    const glm::i64vec3 a(0);
    const glm::i64vec3 b(max, 0, random.whole(0, max / 8));
    const glm::i64vec3 c(0, max, random.whole(0, max / 8));
    std::vector<Corners> floor{{a, b, c}, {b, b + c, c}};
    std::vector<Corners> over = someTriangles(random, 12, max);
    for (int i = 0; i < 20; ++i) {
        Corners corners = floor[static_cast<std::size_t>(i % 2)];
        const glm::i64vec3 up(0, 0, i < 8 ? random.whole(-1, 3) : random.whole(0, max / 4));
        const std::int64_t part = random.whole(1, 16);
        const glm::i64vec3 to = corners[0] + (corners[1] - corners[0]) / part;
        const glm::i64vec3 beside = corners[0] + (corners[2] - corners[0]) / part;
        over.push_back({corners[0] + up, to + up, beside + up});
    }
    scene.add(floor);
    scene.add(over);
    for (int crowd = 0; crowd < 6; ++crowd) {
        const double second = random.real(0, 0.6);
        const double third = random.real(0, 0.3);
        const double spread = std::exp2(random.real(-12, -3));
        const std::uint32_t name = scene.names()[static_cast<std::size_t>(random.whole(0, crowd < 4 ? 1 : 30))];
        for (int i = 0; i < 200; ++i) {
            ScenePoint point;
            point.triangle = name;
            point.second = static_cast<float>(second + random.real(0, spread));
            point.third = static_cast<float>(third + random.real(0, 0.5 * spread));
            point.tolerance = static_cast<std::uint32_t>(random.whole(0, 3)) << 23U;
            scene.points.push_back(point);
        }
    }
    return scene;
}

/// Adds crowds within a rounding or so of where the light lets edges of triangles, or what they bound, fall onto the
/// floor's first triangle, of triangles from `first` on: floats cannot tell on which side of an edge each lies, nor
/// of a sheet that all but touches the floor.
void crowdOnEdges(RandomWholes& random, Scene& scene, const glm::dvec3& light, std::size_t first) {
    const Corners floor = scene.corners(scene.names()[0]);
    const glm::dmat3 toFloor = glm::inverse(glm::dmat3(floor[1] - floor[0], floor[2] - floor[0], -light));
    for (std::size_t i = first; i < scene.names().size(); ++i) {
        const Corners corners = scene.corners(scene.names()[i]);
        const glm::dvec3 edge(corners[1] - corners[0]);
        const glm::dvec3 within = random.whole(0, 1) == 0 ? glm::dvec3(0) : glm::dvec3(corners[2] - corners[0]) * 0.1;
        const glm::dvec3 place = toFloor * (glm::dvec3(corners[0] - floor[0]) + random.real(0.1, 0.9) * edge + within);
        if (std::min(place.x, place.y) < 0.01 || place.x + place.y > 0.99) continue;
        for (int k = 0; k < 64; ++k) {
            ScenePoint point;
            point.triangle = scene.names()[0];
            point.second = static_cast<float>(place.x * (1 + random.real(-0x1p-23, 0x1p-23)));
            point.third = static_cast<float>(place.y * (1 + random.real(-0x1p-23, 0x1p-23)));
            scene.points.push_back(point);
        }
    }
}

TEST(CrowdedCells, EqualThePlainLoop) {
    std::size_t withinTolerance = 0;
    std::size_t dark = 0;
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        SCOPED_TRACE(seed);
        RandomWholes random(seed);
        const std::int64_t max = std::int64_t{1} << random.whole(5, 27);
        Scene scene = someCrowd(random, max);
        const glm::dvec3 towards(random.real(-1, 1), random.real(-1, 1), random.real(0.2, 1));
        const IntegerLight light = roundedLight(glm::normalize(towards));
        const SampleSpace space = spaceOf(light, {1, 2, 4.0 * double(max)}, 1);
        crowdOnEdges(random, scene, glm::dvec3(light.direction), 2);
        const int side = static_cast<int>(random.whole(1, 12));
        const ExactStatistics found = expectSameAsPlain(scene, space, {glm::dmat3(1)}, side);
        EXPECT_GT(found.counts.sampleTests, 32 * found.counts.trianglesRasterized);
        withinTolerance += found.withinTolerance;
        dark += found.dark;
    }
    EXPECT_GT(withinTolerance, 100U);
    EXPECT_GT(dark, 3000U);
}

/// Crowds of points in one place on a floor, each under a sheet that lies a few cells over it, as steep as it is: where
/// the sheet's first corner lies, floats are up to four cells off, and so would be its height over the crowd.
Scene sheetsFarFromTheOrigin(RandomWholes& random) {
    constexpr std::int64_t kFar = std::int64_t{1} << 26;
    constexpr std::int64_t kSide = std::int64_t{1} << 24; // a weight of a point is a place along it
    constexpr std::int64_t kRounding = 8;                 // what floats are apart from kFar on
    Scene scene;
    const glm::i64vec3 corner(kFar, 0, 0);
    const std::uint32_t floor =
        scene.add({{corner, corner + glm::i64vec3(kSide, 0, kSide), corner + glm::i64vec3(0, kSide, 0)}});
    std::vector<Corners> sheets;
    for (int i = 0; i < 20; ++i) {
        const std::int64_t size = std::int64_t{1} << random.whole(6, 16);
        const glm::i64vec3 a = corner + glm::i64vec3(random.whole(1, kSide / 4), random.whole(1, kSide / 4), 0);
        const glm::i64vec3 up(0, 0, a.x - kFar + random.whole(-1, 5));
        sheets.push_back({a + up, a + up + glm::i64vec3(size, 0, size), a + up + glm::i64vec3(0, size, 0)});
        const auto within = [&](std::int64_t from) {
            const std::int64_t place = (from + size / 4) / kRounding * kRounding;
            return static_cast<float>(place) / static_cast<float>(kSide);
        };
        ScenePoint point;
        point.triangle = floor;
        point.second = within(a.x - kFar);
        point.third = within(a.y);
        point.tolerance = static_cast<std::uint32_t>(random.whole(0, 3));
        scene.points.insert(scene.points.end(), 64, point);
    }
    scene.add(sheets);
    return scene;
}

// Floats would have some of them lie under a sheet that touches them, and others above one that casts on them.
TEST(CrowdedCells, LieUnderSheetsThatFloatsCannotPlace) {
    std::size_t withinTolerance = 0;
    std::size_t dark = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        SCOPED_TRACE(seed);
        RandomWholes random(seed);
        const Scene scene = sheetsFarFromTheOrigin(random);
        const SampleSpace space = spaceOf(roundedLight({0, 0, 1}), {1, 2, std::exp2(28)}, 1);
        const ExactStatistics found =
            expectSameAsPlain(scene, space, {glm::dmat3(1)}, static_cast<int>(random.whole(1, 12)));
        withinTolerance += found.withinTolerance;
        dark += found.dark;
    }
    EXPECT_GT(withinTolerance, 500U);
    EXPECT_GT(dark, 1000U);
}

} // namespace
} // namespace gnomon::exact
