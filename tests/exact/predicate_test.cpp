// The predicate against a second one that shares no formula with it, on coordinates small enough to tie often and on
// the largest; and what it promises of meshes.
#include "exact/predicate.h"
#include "tests/exact/plain_intersection.h"
#include "tests/exact/random.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::exact {
namespace {

constexpr std::int64_t kScale = std::int64_t{1} << kWeightBits;

bool operator==(const RayHit& a, const RayHit& b) {
    return a.kind == b.kind && a.isOnEdge == b.isOnEdge;
}

int signOf(std::int64_t value) {
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

TEST(Predicate, EqualsCramersRuleWhereTiesAbound) {
    RandomWholes random(1);
    std::array<int, 3> hits{};
    int ties = 0;
    for (int i = 0; i < 20000; ++i) {
        const Corners caster{random.point(0, 6), random.point(0, 6), random.point(0, 6)};
        const IntegerLight light{random.point(-3, 3) * (std::int64_t{1} << 22)};
        const glm::i64vec3 point =
            random.whole(0, 1) == 0 ? random.point(0, 24) * (kScale / 4) : random.point(0, 6) * kScale;
        const auto tolerance = static_cast<std::uint32_t>(random.whole(0, 3));
        const RayHit hit = intersect(caster, light, point, tolerance);
        ASSERT_TRUE(hit == plainHit(caster, light, point, tolerance)) << i;
        ++hits[static_cast<std::size_t>(hit.kind)];
        ties += hit.isOnEdge ? 1 : 0;
    }
    EXPECT_GT(hits[1], 50);
    EXPECT_GT(hits[2], 300);
    EXPECT_GT(ties, 60);
}

TEST(Predicate, HoldsTheLargestCoordinates) {
    RandomWholes random(2);
    constexpr std::int64_t kMaxCoordinate = (std::int64_t{1} << 31) - 1;
    constexpr std::int64_t kMaxLight = (std::int64_t{1} << kLightBits) - 1;
    // Corners of the cube of all coordinates, of points there, or anything between.
    const auto corner = [&] {
        glm::i64vec3 p;
        for (int axis = 0; axis < 3; ++axis)
            p[axis] = random.whole(0, 2) == 0 ? random.whole(-kMaxCoordinate, kMaxCoordinate)
                                              : random.whole(0, 1) * 2 * kMaxCoordinate - kMaxCoordinate;
        return p;
    };
    int hit = 0;
    for (int i = 0; i < 10000; ++i) {
        const Corners caster{corner(), corner(), corner()};
        IntegerLight light{random.point(-kMaxLight, kMaxLight)};
        light.direction[static_cast<int>(random.whole(0, 2))] = random.whole(0, 1) == 0 ? kMaxLight : -kMaxLight;
        const auto second = static_cast<std::uint32_t>(random.whole(1, kScale - 2));
        const auto third = static_cast<std::uint32_t>(random.whole(1, kScale - 1 - second));
        const glm::i64vec3 point = scaledPoint({{corner(), corner(), corner()}, second, third});
        const std::uint32_t tolerance = random.whole(0, 1) == 0 ? 0 : 0x7FFFFFFFU;
        const RayHit answer = intersect(caster, light, point, tolerance);
        ASSERT_TRUE(answer == plainHit(caster, light, point, tolerance)) << i;
        hit += answer.kind != Hit::None ? 1 : 0;
    }
    EXPECT_GT(hit, 300);
}

TEST(Predicate, ARayThroughAFanMeetsOneOfItsTriangles) {
    const std::vector<glm::i64vec3> rim = {{6, 0, 6}, {5, 5, 6}, {0, 6, 6}, {-5, 5, 6}, {-6, 0, 6}, {0, -6, 6}};
    const glm::i64vec3 hub(0, 0, 6);
    for (const glm::i64vec3 direction : {glm::i64vec3(0, 0, 1), glm::i64vec3(1, 0, 1), glm::i64vec3(-1, 1, 2)}) {
        const IntegerLight light{direction * (std::int64_t{1} << 22)};
        // Through the hub, points of the spokes, and points between them.
        for (const glm::i64vec3 through : {hub, {3, 0, 6}, {0, 3, 6}, {-3, 0, 6}, {0, -2, 6}, {2, 2, 6}, {1, 2, 6}}) {
            const glm::i64vec3 point = (through - direction) * kScale;
            int hits = 0;
            for (std::size_t i = 0; i < rim.size(); ++i) {
                Corners triangle{hub, rim[i], rim[(i + 1) % rim.size()]};
                std::rotate(triangle.begin(), triangle.begin() + static_cast<int>(i) % 3, triangle.end());
                if (i % 2 == 0) std::swap(triangle[0], triangle[1]);
                hits += intersect(triangle, light, point, 0).kind == Hit::Ahead ? 1 : 0;
            }
            EXPECT_EQ(hits, 1);
        }
    }
}

TEST(Predicate, ARayEntersATetrahedronAsOftenAsItLeaves) {
    RandomWholes random(3);
    int ties = 0;
    int inside = 0;
    for (int i = 0; i < 20000; ++i) {
        const std::array<glm::i64vec3, 4> corners{
            random.point(0, 6), random.point(0, 6), random.point(0, 6), random.point(0, 6)};
        const glm::i64vec3 point = random.point(0, 12) * (kScale / 2);
        const IntegerLight light{random.point(-2, 2) * (std::int64_t{1} << 22)};
        const std::array<Corners, 4> faces{
            Corners{corners[0], corners[1], corners[2]},
            Corners{corners[0], corners[3], corners[1]},
            Corners{corners[1], corners[3], corners[2]},
            Corners{corners[2], corners[3], corners[0]}};
        std::array<int, 4> sides{};
        int crossings = 0;
        bool isTie = false;
        for (std::size_t k = 0; k < 4; ++k) {
            sides[k] = visibleSide(faces[k], point);
            const RayHit hit = intersect(faces[k], light, point, 0);
            if (hit.kind == Hit::Ahead) crossings += facing(faces[k], light);
            isTie = isTie || hit.isOnEdge;
        }
        // A point in the plane of a face is on neither side of it.
        if (std::count(sides.begin(), sides.end(), 0) > 0 || light.direction == glm::i64vec3(0)) continue;
        const bool isInside = std::count(sides.begin(), sides.end(), sides[0]) == 4;
        EXPECT_EQ(crossings, isInside ? -sides[0] : 0) << i;
        ties += isTie ? 1 : 0;
        inside += isInside ? 1 : 0;
    }
    EXPECT_GT(ties, 200);
    EXPECT_GT(inside, 200);
}

TEST(Predicate, ItsOwnPlaneAndTheLightsPlaneCastNothing) {
    RandomWholes random(4);
    for (int i = 0; i < 5000; ++i) {
        const Corners corners{random.point(-99, 99), random.point(-99, 99), random.point(-99, 99)};
        const auto second = static_cast<std::uint32_t>(random.whole(1, kScale - 2));
        const auto third = static_cast<std::uint32_t>(random.whole(1, kScale - 1 - second));
        const glm::i64vec3 point = scaledPoint({corners, second, third});
        const IntegerLight light{random.point(-kScale + 1, kScale - 1)};
        EXPECT_EQ(intersect(corners, light, point, 0).kind, Hit::None);
        // A larger triangle in the same plane that covers the point.
        const Corners coplanar{corners[0] * 3L - corners[1] - corners[2], corners[1], corners[2]};
        EXPECT_EQ(intersect(coplanar, light, point, 0).kind, Hit::None);
        // The light along an edge of it, or anywhere in its plane.
        const IntegerLight within{
            (corners[1] - corners[0]) * random.whole(-9, 9) + (corners[2] - corners[0]) * random.whole(-9, 9)};
        EXPECT_EQ(facing(corners, within), 0);
        EXPECT_EQ(intersect(corners, within, point - within.direction, 0).kind, Hit::None);
        EXPECT_EQ(signOf(visibleSide(corners, point)), 0);
    }
}

TEST(Predicate, KnowsWhatLiesInAPlane) {
    RandomWholes random(6);
    std::array<int, 2> found{};
    for (int i = 0; i < 5000; ++i) {
        const Corners corners{random.point(-9, 9), random.point(-9, 9), random.point(-9, 9)};
        const glm::i64vec3 point = random.whole(0, 1) == 0
                                       ? random.point(-9, 9) * (kScale / 2)
                                       : corners[0] * kScale + (corners[1] - corners[0]) * random.whole(-5, 5) +
                                             (corners[2] - corners[0]) * random.whole(-5, 5);
        // The volume over it, in edges from the point: another formula.
        const auto edge = [&](std::size_t k) { return corners[k] * kScale - point; };
        const glm::dvec3 a(edge(0)), b(edge(1)), c(edge(2));
        const double volume = glm::dot(glm::cross(a * 0x1p-24, b * 0x1p-24), c * 0x1p-24);
        const bool isIn = isInPlane(corners, point);
        EXPECT_EQ(isIn, std::abs(volume) < 0x1p-40) << volume;
        ++found[isIn ? 1 : 0];
    }
    EXPECT_GT(found[0], 1000);
    EXPECT_GT(found[1], 1000);
}

TEST(Predicate, AsFarAsTheToleranceStillTouches) {
    const Corners caster{glm::i64vec3(-9, -9, 5), glm::i64vec3(9, -9, 5), glm::i64vec3(0, 9, 5)};
    const IntegerLight light{{0, 0, (1 << 24) - 1}};
    for (const std::uint32_t tolerance : {1U, 2U, 1000U, 0x7FFFFFFFU}) {
        const std::int64_t ahead = std::int64_t{tolerance} * light.direction.z;
        const glm::i64vec3 point(0, 0, 5 * kScale - ahead);
        EXPECT_EQ(intersect(caster, light, point, tolerance).kind, Hit::WithinTolerance);
        EXPECT_EQ(intersect(caster, light, point, tolerance - 1).kind, Hit::Ahead);
        EXPECT_EQ(intersect(caster, light, point - glm::i64vec3(0, 0, 1), tolerance).kind, Hit::Ahead);
    }
    EXPECT_EQ(intersect(caster, light, {0, 0, 5 * kScale}, 7).kind, Hit::None);
    EXPECT_EQ(intersect(caster, light, {0, 0, 5 * kScale + 1}, 7).kind, Hit::None);
    EXPECT_EQ(intersect(caster, light, {0, 0, 5 * kScale - 1}, 0).kind, Hit::Ahead);
}

} // namespace
} // namespace gnomon::exact
