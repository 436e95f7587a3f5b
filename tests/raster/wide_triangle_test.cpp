// Rows of large triangles against looking at every pixel, and the plane of their depth against its corners.
#include "core/random.h"
#include "raster/wide_triangle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::raster {
namespace {

std::array<SnappedVertex, 3> randomCorners(Random& random, double reach) {
    std::array<SnappedVertex, 3> corners;
    for (SnappedVertex& corner : corners)
        corner = snappedTo(
            random.uniform(-reach, reach) * kSubpixels,
            random.uniform(-reach, reach) * kSubpixels,
            static_cast<float>(random.uniform(-0.2, 1.2)));
    if (random.below(3) == 0) corners[1].y = corners[0].y; // a level edge
    if (random.below(3) == 0) corners[2].x = corners[0].x; // an upright one
    return corners;
}

/// The side of a directed edge on which a pixel's centre lies, less one where the edge does not own its pixels.
std::int64_t sideOf(const SnappedVertex& a, const SnappedVertex& b, int x, int y) {
    const std::int64_t px = std::int64_t{x} * kSubpixels;
    const std::int64_t py = std::int64_t{y} * kSubpixels;
    const bool owns = b.y < a.y || (b.y == a.y && b.x > a.x);
    return std::int64_t{b.x - a.x} * (py - a.y) - std::int64_t{b.y - a.y} * (px - a.x) - (owns ? 0 : 1);
}

bool isInside(const WideTriangle& wide, int x, int y) {
    const auto& c = wide.corners;
    return sideOf(c[0], c[1], x, y) >= 0 && sideOf(c[1], c[2], x, y) >= 0 && sideOf(c[2], c[0], x, y) >= 0;
}

constexpr PixelBox kTile{-40, -30, 30, 40};

using DrawnTile = std::array<std::array<bool, 70>, 70>;

bool& at(DrawnTile& tile, int x, int y) {
    return tile.at(static_cast<std::size_t>(y - kTile.y0)).at(static_cast<std::size_t>(x - kTile.x0));
}

/// The pixels of the rows of a triangle in the tile.
DrawnTile drawnRows(const WideTriangle& wide) {
    DrawnTile drawn{};
    for (WideRows rows(wide, kTile); !rows.atEnd();) {
        const WideRow row = rows.next();
        for (int x = row.x0; x < row.x1; ++x)
            at(drawn, x, row.y) = true; // throws for a pixel outside of the tile
    }
    return drawn;
}

TEST(WideTriangle, RowsHoldThePixelsInsideAndNoOther) {
    Random random(1);
    int covered = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const std::array<SnappedVertex, 3> corners = randomCorners(random, trial % 2 == 0 ? 90 : 3000);
        if (doubleArea(corners) == 0) continue;
        const WideTriangle wide = wideTriangle(corners);
        EXPECT_GT(doubleArea(wide.corners), 0) << "turned counter-clockwise";
        DrawnTile drawn = drawnRows(wide);
        for (int y = kTile.y0; y < kTile.y1; ++y)
            for (int x = kTile.x0; x < kTile.x1; ++x) {
                ASSERT_EQ(at(drawn, x, y), isInside(wide, x, y)) << trial << ": " << x << ", " << y;
                covered += at(drawn, x, y) ? 1 : 0;
            }
    }
    EXPECT_GT(covered, 1000000);
}

TEST(WideTriangle, TheBoxIsThatOfThePixelCentresBetweenTheCorners) {
    const auto at = [](int x, int y) { return SnappedVertex{x, y, 0.5F, 0, 0}; };
    const WideTriangle wide = wideTriangle({at(1, 256), at(2560, 257), at(300, 5000)});
    EXPECT_EQ(wide.box, (PixelBox{1, 1, 11, 20}));
    EXPECT_EQ(wideTriangle({at(0, 0), at(2559, 0), at(0, 5119)}).box, (PixelBox{0, 0, 10, 20}));
    EXPECT_EQ(wideTriangle({at(-1, -257), at(2560, 0), at(0, 5120)}).box, (PixelBox{0, -1, 11, 21}));
}

TEST(WideTriangle, DepthIsThePlaneThroughTheUnsnappedCorners) {
    Random random(2);
    for (int trial = 0; trial < 2000; ++trial) {
        const std::array<SnappedVertex, 3> corners = randomCorners(random, 500);
        if (std::abs(doubleArea(corners)) < (std::int64_t{1} << 30U)) continue;
        const WideTriangle wide = wideTriangle(corners);
        const SnappedVertex& a = wide.corners[0];
        for (const SnappedVertex& corner : corners) {
            const double dx = (corner.x - a.x + double{restOf(corner.restX)} - restOf(a.restX)) / kSubpixels;
            const double dy = (corner.y - a.y + double{restOf(corner.restY)} - restOf(a.restY)) / kSubpixels;
            EXPECT_NEAR(a.z + wide.depthPerX * dx + wide.depthPerY * dy, corner.z, 1e-9);
        }
        const auto [min, max] = std::minmax({corners[0].z, corners[1].z, corners[2].z});
        EXPECT_EQ(wide.minDepth, std::clamp(min, 0.0F, 1.0F));
        EXPECT_EQ(wide.maxDepth, std::clamp(max, 0.0F, 1.0F));
        WideRows rows(wide, {-500, -500, 500, 500});
        EXPECT_EQ(rows.depthPerX(), static_cast<float>(wide.depthPerX));
        EXPECT_EQ(rows.referenceX(), a.x >> kSubpixelBits);
        for (int i = 0; i < 3 && !rows.atEnd(); ++i) {
            const WideRow row = rows.next();
            const double dx = rows.referenceX() - (a.x + double{restOf(a.restX)}) / kSubpixels;
            const double dy = row.y - (a.y + double{restOf(a.restY)}) / kSubpixels;
            EXPECT_NEAR(row.depthAtReference, a.z + wide.depthPerX * dx + wide.depthPerY * dy, 1e-3);
        }
    }
}

// Snapping turned the triangle over, or nearly: its true area gives no plane, so that of the snapped corners is taken.
TEST(WideTriangle, ASliverThatSnappingMadeKeepsAFinitePlane) {
    std::array<SnappedVertex, 3> corners{
        SnappedVertex{0, 0, 0, 0, 0},
        SnappedVertex{256 * 100, 0, 1, 0, 32767},
        SnappedVertex{256 * 75, 1, 0.5F, 0, -32768}};
    const WideTriangle wide = wideTriangle(corners);
    EXPECT_TRUE(std::isfinite(wide.depthPerX));
    EXPECT_TRUE(std::isfinite(wide.depthPerY));
    EXPECT_NEAR(wide.depthPerX, 0.01, 1e-6);
    EXPECT_EQ(wide.corners[1].restY, 0) << "without its rests";
}

TEST(QuotientWalk, StepsAsAFloorDivisionDoes) {
    Random random(3);
    for (int trial = 0; trial < 500; ++trial) {
        const auto divisor = static_cast<std::int64_t>(1 + random.below(1000));
        const auto floorOf = [&](std::int64_t value) {
            return static_cast<std::int64_t>(std::floor(static_cast<double>(value) / static_cast<double>(divisor)));
        };
        auto value = static_cast<std::int64_t>(random.below(100000)) - 50000;
        const auto perRow = static_cast<std::int64_t>(random.below(10000)) - 5000;
        QuotientWalk walk{
            floorOf(value),
            value - floorOf(value) * divisor,
            floorOf(perRow),
            perRow - floorOf(perRow) * divisor,
            divisor};
        for (int row = 0; row < 50; ++row) {
            ASSERT_EQ(walk.quotient, floorOf(value));
            ASSERT_EQ(walk.rest, value - floorOf(value) * divisor);
            walk.step();
            value += perRow;
        }
    }
}

} // namespace
} // namespace gnomon::raster
