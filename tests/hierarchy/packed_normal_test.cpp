// Normals on the octahedron: how far a direction is turned by packing, and the grid's arithmetic.
#include "core/random.h"
#include "hierarchy/grid.h"
#include "hierarchy/octahedral.h"

#include <gtest/gtest.h>

#include <limits>

namespace gnomon::hierarchy {
namespace {

double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(2 * std::asin(std::min(1.0, glm::distance(glm::normalize(a), glm::normalize(b)) / 2)));
}

TEST(PackedNormal, IsWithinAboutAQuarterOfADegree) {
    Random random(1);
    double worst = 0;
    double sum = 0;
    constexpr int kCount = 200000;
    for (int i = 0; i < kCount; ++i) {
        const glm::dvec3 direction(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        const std::uint32_t packed = packNormal(direction * std::exp(random.uniform(-30, 30)));
        const glm::dvec3 unpacked = unpackNormal(packed);
        EXPECT_NEAR(glm::length(unpacked), 1, 1e-12);
        const double turned = degreesBetween(direction, unpacked);
        worst = std::max(worst, turned);
        sum += turned;
        EXPECT_EQ(packed & 0x003F003FU, 0U) << "the low six bits of both numbers cost nothing";
    }
    EXPECT_LT(worst, 0.28);
    EXPECT_LT(sum / kCount, 0.09) << "rounded to the nearest, not to a side";
}

TEST(PackedNormal, AxesAndDiagonalsAreExactOrNearlySo) {
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            glm::dvec3 direction(0);
            direction[axis] = sign;
            EXPECT_LT(degreesBetween(direction, unpackNormal(packNormal(direction))), 0.16) << axis << sign;
        }
    EXPECT_EQ(unpackNormal(packNormal({0, 0, 1})), glm::dvec3(0, 0, 1));
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0})
            for (const double z : {-1.0, 1.0}) {
                const glm::dvec3 unpacked = unpackNormal(packNormal({x, y, z}));
                EXPECT_LT(degreesBetween({x, y, z}, unpacked), 0.2);
                EXPECT_GT(unpacked.x * x, 0);
                EXPECT_GT(unpacked.y * y, 0);
                EXPECT_GT(unpacked.z * z, 0);
            }
}

TEST(PackedNormal, OnePackedAgainIsTheSameInside) {
    for (int x = -511; x <= 511; x += 7)
        for (int y = -511 + std::abs(x); y <= 511 - std::abs(x); y += 7) { // the upper half: no fold to round across
            const std::uint32_t packed =
                (static_cast<std::uint32_t>(x * 64) & 0xFFFFU) | static_cast<std::uint32_t>(y * 64) << 16U;
            EXPECT_EQ(packNormal(unpackNormal(packed)), packed) << x << ' ' << y;
        }
}

TEST(PackedNormal, NoDirectionIsNone) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& none :
         {glm::dvec3(0), glm::dvec3(kNan, 1, 0), glm::dvec3(0, 0, kInfinite), glm::dvec3(0, -kInfinite, 1)})
        EXPECT_EQ(packNormal(none), kNoNormal);
    EXPECT_EQ(unpackNormal(kNoNormal), glm::dvec3(0));
    EXPECT_NE(packNormal({-1, -1, 0}), kNoNormal) << "the corner of the octahedron is a direction";
}

TEST(Grid, PointsLieOnMultiplesOfItsStep) {
    const Grid grid{{1e7, -2, 0.5}, -3};
    EXPECT_EQ(grid.step(), 0.125);
    EXPECT_EQ(grid.local(GridPoint{8, 16, 1}), glm::dvec3(1, 2, 0.125));
    EXPECT_EQ(grid.world({8, 16, 1}), glm::dvec3(1e7 + 1, 0, 0.625));
    EXPECT_EQ(Grid{}.step(), 1);
    EXPECT_DOUBLE_EQ(grid.snapError(), glm::length(glm::dvec3(0.125)) / 2);
    GridBox box;
    box.add(GridPoint{3, 9, 5});
    box.add(GridPoint{7, 2, 5});
    EXPECT_EQ(box.min, (GridPoint{3, 2, 5}));
    EXPECT_EQ(box.max, (GridPoint{7, 9, 5}));
    GridBox more;
    more.add(GridPoint{1, 9, 6});
    more.add(box);
    EXPECT_EQ(more.min, (GridPoint{1, 2, 5}));
    EXPECT_EQ(more.max, (GridPoint{7, 9, 6}));
    EXPECT_EQ(grid.local(more).max, glm::dvec3(0.875, 1.125, 0.75));
    EXPECT_EQ(grid.local(more).min, glm::dvec3(0.125, 0.25, 0.625));
}

} // namespace
} // namespace gnomon::hierarchy
