// Spans, floors and straight runs, each beside a slow one over samples or over all cells.
#include "core/random.h"
#include "path/solid_spans.h"
#include "path/walkable_floor.h"
#include "path/way_smoothing.h"
#include "tests/support/random_point.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::path {
namespace {

/// The heights of a triangle's points within `margin` of a column, by points on a fine grid of it.
std::pair<double, double> sampledHeights(
    const std::array<glm::dvec3, 3>& t, const ColumnGrid& grid, const glm::ivec2& column, double margin) {
    constexpr int kSteps = 160;
    std::pair<double, double> heights(
        std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
    for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; i + j <= kSteps; ++j) {
            const double u = static_cast<double>(i) / kSteps;
            const double v = static_cast<double>(j) / kSteps;
            const glm::dvec3 p = t[0] * (1 - u - v) + t[1] * u + t[2] * v;
            const glm::dvec2 at = glm::dvec2(p.x, p.z) - glm::dvec2(column) * grid.cell;
            const glm::dvec2 beside = glm::max(glm::max(-at, at - grid.cell), glm::dvec2(0));
            if (std::max(beside.x, beside.y) > margin) continue;
            heights = {std::min(heights.first, p.y), std::max(heights.second, p.y)};
        }
    return heights;
}

TEST(SolidSpans, HoldATrianglesHeightsOverEachColumn) {
    Random random(5);
    const ColumnGrid grid({glm::dvec3(0), glm::dvec3(5.9, 6, 5.9)}, 1, 0.25);
    for (int trial = 0; trial < 40; ++trial) {
        const std::array<glm::dvec3, 3> triangle{
            randomPoint(random, Box{glm::dvec3(0), glm::dvec3(6)}),
            randomPoint(random, Box{glm::dvec3(0), glm::dvec3(6)}),
            randomPoint(random, Box{glm::dvec3(0), glm::dvec3(6)})};
        const double margin = trial % 2 == 0 ? 0 : 0.3;
        SolidSpans solid(grid, 1, margin);
        solid.add(triangle);
        std::vector<SolidSpan> spans;
        for (int z = 0; z < grid.depth; ++z)
            for (int x = 0; x < grid.width; ++x) {
                solid.read(x, z, spans);
                const auto [low, high] = sampledHeights(triangle, grid, {x, z}, margin);
                const auto [wideLow, wideHigh] = sampledHeights(triangle, grid, {x, z}, margin + 0.1);
                ASSERT_LE(spans.size(), 1U);
                if (low <= high) { // what the samples meet is solid
                    ASSERT_EQ(spans.size(), 1U) << "trial " << trial << " at " << x << ", " << z;
                    EXPECT_LE(spans[0].bottom * grid.rise, low - margin + 1e-9);
                    EXPECT_GE(spans[0].top * grid.rise, high + margin - 1e-9);
                }
                if (spans.empty()) continue; // what is solid is met a little farther around
                EXPECT_GE(spans[0].bottom * grid.rise, wideLow - margin - grid.rise - 0.1);
                EXPECT_LE(spans[0].top * grid.rise, wideHigh + margin + grid.rise + 0.1);
            }
    }
}

TEST(SolidSpans, AreTheSameInAnyOrderAndCloseWhatNobodyStandsIn) {
    Random random(6);
    const ColumnGrid grid({glm::dvec3(0), glm::dvec3(0.9, 40, 0.9)}, 1, 0.25);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<std::array<glm::dvec3, 3>> triangles;
        for (int i = 0; i < 12; ++i) {
            const double y = random.uniform(0, 40);
            triangles.push_back({glm::dvec3(0.1, y, 0.1), glm::dvec3(0.8, y + random.unit(), 0.1), {0.1, y, 0.8}});
        }
        SolidSpans one(grid, 8, 0);
        SolidSpans other(grid, 8, 0);
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            one.add(triangles[i]);
            other.add(triangles[triangles.size() - 1 - i]);
        }
        std::vector<SolidSpan> a;
        std::vector<SolidSpan> b;
        one.read(0, 0, a);
        other.read(0, 0, b);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_EQ(a[i].bottom, b[i].bottom);
            EXPECT_EQ(a[i].top, b[i].top);
            if (i > 0) {
                EXPECT_GE(a[i].bottom - a[i - 1].top, 8);
            }
        }
    }
}

/// A level floor of 6 m with posts here and there, at cells of 0.1 m.
struct Posts {
    ColumnGrid grid{{glm::dvec3(0), glm::dvec3(5.95, 3, 5.95)}, 0.1, 0.02};
    std::vector<bool> isPost = std::vector<bool>(grid.columnCount(), false);

    WalkableFloor floor(std::uint64_t seed, int posts) {
        SolidSpans solid(grid, 95, 0);
        const auto addQuad = [&](const glm::dvec3& a, const glm::dvec3& u, const glm::dvec3& v) {
            solid.add({a, a + u, a + u + v});
            solid.add({a, a + u + v, a + v});
        };
        addQuad({0.01, 0.01, 0.01}, {5.98, 0, 0}, {0, 0, 5.98});
        Random random(seed);
        for (int i = 0; i < posts; ++i) {
            const auto column = static_cast<std::size_t>(random.below(grid.columnCount()));
            isPost[column] = true;
            const glm::dvec2 middle = (glm::dvec2(glm::uvec2(column % 60, column / 60)) + 0.5) * 0.1;
            addQuad({middle.x - 0.02, 0, middle.y}, {0.04, 0, 0}, {0, 2.5, 0});
        }
        return {solid, WalkBody{}};
    }

    /// The distance from a column's middle to the nearest post's column, or to the edge of the floor.
    double clearance(const glm::ivec2& at) const {
        const glm::dvec2 middle = (glm::dvec2(at) + 0.5) * 0.1;
        double nearest = std::min(std::min(middle.x, middle.y), std::min(6 - middle.x, 6 - middle.y));
        for (std::size_t i = 0; i < isPost.size(); ++i) {
            if (!isPost[i]) continue;
            const glm::dvec2 low = 0.1 * glm::dvec2(glm::uvec2(i % 60, i / 60));
            const glm::dvec2 beside = glm::max(glm::max(low - middle, middle - low - 0.1), glm::dvec2(0));
            nearest = std::min(nearest, glm::length(beside));
        }
        return nearest;
    }
};

TEST(WalkableFloor, KeepsTheBodysRadiusAndNoMuchMore) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        Posts posts;
        const WalkableFloor floor = posts.floor(seed, 60);
        for (std::uint32_t i = 0; i < floor.cells().size(); ++i) {
            if (floor.height(floor.cells()[i].floor) > 1) continue; // on a post
            const double clear = posts.clearance(floor.placeOf(floor.cells()[i].column));
            if (floor.isWalkable(i)) {
                EXPECT_GE(clear, 0.2) << "seed " << seed;
            } else {
                EXPECT_LT(clear, 0.36) << "seed " << seed;
            }
        }
    }
}

TEST(WalkableFloor, ASlopeIsWalkedUpToAboutFortyFiveDegrees) {
    Random random(12);
    const ColumnGrid grid({glm::dvec3(0), glm::dvec3(3.95, 9, 3.95)}, 0.1, 0.02);
    for (int trial = 0; trial < 60; ++trial) {
        const double rise = random.uniform(0, 2); // over run
        if (rise > 0.9 && rise < 1.3) continue;
        const double turn = random.uniform(0, 6.28);
        const auto at = [&](double x, double z) {
            return glm::dvec3(x, 4 + rise * ((x - 2) * std::cos(turn) + (z - 2) * std::sin(turn)), z);
        };
        SolidSpans solid(grid, 95, 0);
        solid.add({at(0, 0), at(4, 0), at(4, 4)});
        solid.add({at(0, 0), at(4, 4), at(0, 4)});
        const WalkableFloor floor(solid, WalkBody{});
        const std::uint32_t middle = floor.nearest(20, 20, 200, 20);
        ASSERT_NE(middle, FloorCell::kNone);
        EXPECT_EQ(floor.isWalkable(middle), rise < 1) << rise << " over 1, turned by " << turn;
    }
}

TEST(WalkableFloor, AStepUpUnderALowCeilingIsNoWay) {
    const ColumnGrid grid({glm::dvec3(0), glm::dvec3(3.95, 4, 1.95)}, 0.1, 0.02);
    for (const double lift : {0.0, 0.2}) { // of the step; the ceilings are 2 m over their floors
        SolidSpans solid(grid, 95, 0);
        const auto addPlate = [&](double x, double y) {
            solid.add({glm::dvec3(x, y, 0.01), glm::dvec3(x + 1.98, y, 0.01), glm::dvec3(x + 1.98, y, 1.99)});
            solid.add({glm::dvec3(x, y, 0.01), glm::dvec3(x + 1.98, y, 1.99), glm::dvec3(x, y, 1.99)});
        };
        for (const double height : {0.01, 2.01}) {
            addPlate(0.01, height);
            addPlate(2.01, height + lift);
        }
        const WalkableFloor floor(solid, WalkBody{});
        const std::uint32_t start = floor.nearest(10, 10, 1, 2);
        ASSERT_NE(start, FloorCell::kNone);
        EXPECT_EQ(runStraight(floor, {{10.5, 10.5}, start}, {30.5, 10.5}).end != FloorCell::kNone, lift == 0);
    }
}

TEST(StraightRun, ReachesWhatSamplesOfTheLineReach) {
    Random random(8);
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        Posts posts;
        const WalkableFloor floor = posts.floor(seed, 30);
        for (int trial = 0; trial < 400; ++trial) {
            const glm::dvec2 a{random.uniform(1, 59), random.uniform(1, 59)};
            const glm::dvec2 b{random.uniform(1, 59), random.uniform(1, 59)};
            const auto cellAt = [&](const glm::dvec2& p) {
                return floor.nearest(static_cast<int>(p.x), static_cast<int>(p.y), 2, 3);
            };
            if (cellAt(a) == FloorCell::kNone || !floor.isWalkable(cellAt(a))) continue;
            bool isFree = true;
            for (int i = 0; i <= 4000 && isFree; ++i) {
                const std::uint32_t cell = cellAt(glm::mix(a, b, i / 4000.0));
                isFree = cell != FloorCell::kNone && floor.isWalkable(cell);
            }
            const StraightRun run = runStraight(floor, {a, cellAt(a)}, b);
            if (run.end == FloorCell::kNone) {
                EXPECT_LT(run.free, glm::distance(a, b));
            } else {
                EXPECT_TRUE(isFree) << "seed " << seed << ", trial " << trial;
                EXPECT_EQ(run.end, cellAt(b));
                EXPECT_GE(run.cost, 0.999 * glm::distance(a, b));
            }
        }
    }
}

TEST(WalkableFloor, StepsFromBarToBarOfAGratingButOverNoWideGap) {
    const ColumnGrid grid({glm::dvec3(0), glm::dvec3(9.9, 3, 3.9)}, 0.1, 0.02);
    for (const bool isBars : {true, false}) {
        SolidSpans solid(grid, 95, 0);
        for (int i = 0; i < 10; ++i) {
            const double x = i + 0.04;
            const double width = isBars || i == 9 ? 0.03 : i % 2 == 0 ? 0.98 : 0; // bars, or plates a metre apart
            solid.add({glm::dvec3(x, 1, 0), glm::dvec3(x + width, 1, 0), glm::dvec3(x + width, 1, 3.99)});
            solid.add({glm::dvec3(x, 1, 0), glm::dvec3(x + width, 1, 3.99), glm::dvec3(x, 1, 3.99)});
        }
        const WalkableFloor floor(solid, WalkBody{});
        const std::uint32_t start = floor.nearest(6, 20, 51, 5);
        const std::uint32_t middle = floor.nearest(20, 20, 51, 5);
        ASSERT_NE(middle, FloorCell::kNone);
        const std::uint32_t end = runStraight(floor, {{20.5, 20.5}, middle}, {45.5, 20.5}).end;
        EXPECT_EQ(end != FloorCell::kNone, isBars);
        EXPECT_NE(start, FloorCell::kNone);
    }
}

} // namespace
} // namespace gnomon::path
