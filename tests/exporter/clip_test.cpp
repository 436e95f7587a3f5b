// Triangles cut off at cells: against points drawn at random, and that cells share a triangle without rest.
#include "core/random.h"
#include "preprocess/exporter/tiles/clip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace gnomon::exporter {
namespace {

using Place = std::array<double, 3>;

Place crossOf(const Place& a, const Place& b, const Place& c) {
    Place u{};
    Place v{};
    for (std::size_t i = 0; i < 3; ++i) {
        u[i] = b[i] - a[i];
        v[i] = c[i] - a[i];
    }
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

double areaOf(const std::vector<ClippedCorner>& polygon) {
    double area = 0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const Place cross = crossOf(polygon[0].place, polygon[i].place, polygon[i + 1].place);
        area += std::sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]) / 2;
    }
    return area;
}

/// Corners at whole numbers below `side`, as those of a mesh lie.
std::array<ClippedCorner, 3> randomTriangle(Random& random, std::uint64_t side) {
    std::array<ClippedCorner, 3> triangle{};
    for (ClippedCorner& corner : triangle)
        for (std::size_t i = 0; i < 3; ++i) {
            corner.place[i] = static_cast<double>(random.below(side));
            corner.normal[i] = random.uniform(-1, 1);
            corner.color[i] = static_cast<double>(random.below(256));
        }
    return triangle;
}

TEST(Clipped, CellsShareATriangleWithoutRest) {
    Random random(1);
    for (int round = 0; round < 400; ++round) {
        // Many of the corners of the coarser half lie in sides of cells.
        auto triangle = randomTriangle(random, round % 2 == 0 ? 64 : 5);
        if (round % 2 != 0)
            for (ClippedCorner& corner : triangle)
                for (double& value : corner.place)
                    value *= 16;
        double sum = 0;
        for (std::uint64_t x = 0; x < 80; x += 16)
            for (std::uint64_t y = 0; y < 80; y += 16)
                for (std::uint64_t z = 0; z < 80; z += 16)
                    sum += areaOf(clipped(triangle, {{x, y, z}, 16}));
        const double whole = areaOf({triangle.begin(), triangle.end()});
        EXPECT_NEAR(sum, whole, 1e-9 * whole + 1e-12) << round;
    }
}

TEST(Clipped, WhatIsLeftLiesInTheCellAndInThePlane) {
    Random random(2);
    int left = 0;
    for (int round = 0; round < 2000; ++round) {
        const auto triangle = randomTriangle(random, 64);
        const TileCell cell{{16 * random.below(4), 16 * random.below(4), 16 * random.below(4)}, 16};
        const Place normal = crossOf(triangle[0].place, triangle[1].place, triangle[2].place);
        for (const ClippedCorner& corner : clipped(triangle, cell)) {
            ++left;
            double off = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                EXPECT_GE(corner.place[i], static_cast<double>(cell.low[i]));
                EXPECT_LE(corner.place[i], static_cast<double>(cell.low[i] + cell.side));
                off += normal[i] * (corner.place[i] - triangle[0].place[i]);
            }
            EXPECT_LT(std::abs(off), 1e-6) << "steps times an area";
        }
    }
    EXPECT_GT(left, 500);
}

// The slow, obviously right way: a point is in what is left exactly if it is in the triangle and in the cell.
TEST(Clipped, PointsOfTheTriangleInTheCellAreInWhatIsLeft) {
    Random random(3);
    for (int round = 0; round < 300; ++round) {
        auto triangle = randomTriangle(random, 64);
        for (ClippedCorner& corner : triangle)
            corner.place[2] = 8; // in the plane of a cell's middle, so that two numbers say where a point is
        const TileCell cell{{16 * random.below(4), 16 * random.below(4), 0}, 16};
        const std::vector<ClippedCorner> polygon = clipped(triangle, cell);
        const auto isIn = [](const auto& corners, const Place& p) {
            bool hasLeft = false;
            bool hasRight = false;
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const double side = crossOf(corners[i].place, corners[(i + 1) % corners.size()].place, p)[2];
                hasLeft |= side > 1e-9;
                hasRight |= side < -1e-9;
            }
            return corners.size() > 2 && !(hasLeft && hasRight);
        };
        if (std::abs(crossOf(triangle[0].place, triangle[1].place, triangle[2].place)[2]) < 1) continue;
        for (int i = 0; i < 50; ++i) {
            const Place p{
                static_cast<double>(cell.low[0]) + random.uniform(0.01, 15.99),
                static_cast<double>(cell.low[1]) + random.uniform(0.01, 15.99),
                8};
            EXPECT_EQ(isIn(polygon, p), isIn(triangle, p)) << round;
        }
    }
}

TEST(Clipped, ASharedEdgeIsCutAtTheSamePlace) {
    Random random(4);
    for (int round = 0; round < 500; ++round) {
        auto one = randomTriangle(random, 1U << 19U);
        auto other = randomTriangle(random, 1U << 19U);
        for (auto* const triangle : {&one, &other})
            for (ClippedCorner& corner : *triangle)
                corner.place[0] *= 2;
        const TileCell cell{{1U << 19U, 0, 0}, 1U << 19U}; // cuts across x alone
        const auto onSide = [&](const std::array<ClippedCorner, 3>& triangle) {
            std::set<Place> places;
            for (const ClippedCorner& corner : clipped(triangle, cell))
                if (corner.place[0] == static_cast<double>(cell.low[0])) places.insert(corner.place);
            return places;
        };
        const std::set<Place> first = onSide({one[0], one[1], one[2]});
        const std::set<Place> second = onSide({one[1], one[0], other[2]});
        const auto half = static_cast<double>(cell.low[0]);
        if ((one[0].place[0] < half) == (one[1].place[0] < half)) continue;
        std::set<Place> shared;
        for (const Place& place : first)
            if (second.count(place) > 0) shared.insert(place);
        EXPECT_EQ(shared.size(), 1U) << round;
    }
}

TEST(Clipped, WhatLiesInASideIsTheUpperCells) {
    std::array<ClippedCorner, 3> triangle{};
    triangle[0].place = {16, 1, 1};
    triangle[1].place = {16, 9, 1};
    triangle[2].place = {16, 1, 9};
    EXPECT_TRUE(clipped(triangle, {{0, 0, 0}, 16}).empty());
    const std::vector<ClippedCorner> kept = clipped(triangle, {{16, 0, 0}, 16});
    ASSERT_EQ(kept.size(), 3U);
    EXPECT_TRUE(liesOnSide(kept[0], kept[1], {{16, 0, 0}, 16}));
    EXPECT_FALSE(liesOnSide(kept[0], kept[1], {{0, 0, 0}, 32}));
}

TEST(Clipped, ValuesAreThoseOfThePlace) {
    std::array<ClippedCorner, 3> triangle{};
    triangle[1].place = {32, 0, 0};
    triangle[2].place = {0, 32, 0};
    triangle[1].color = {200, 0, 0, 255};
    triangle[1].normal = {1, 0, 0};
    for (const ClippedCorner& corner : clipped(triangle, {{16, 0, 0}, 16})) {
        EXPECT_DOUBLE_EQ(corner.color[0], 200 * corner.place[0] / 32);
        EXPECT_DOUBLE_EQ(corner.normal[0], corner.place[0] / 32);
    }
}

} // namespace
} // namespace gnomon::exporter
