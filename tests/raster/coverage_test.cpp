// No hole and no pixel covered twice: closed fans of random triangles.
#include "raster/wide_triangle.h"
#include "tests/raster/homogeneous_triangle.h"
#include "tests/raster/scenes.h"
#include "tests/support/sanitizers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::raster {
namespace {

constexpr int kCoverageSide = 96;
constexpr PixelBox kCoverageViewport = {0, 0, kCoverageSide, kCoverageSide};
using Position = std::array<std::uint32_t, 3>;

std::uint32_t cells(double pixels) {
    return static_cast<std::uint32_t>(kSceneCenter + std::llround(pixels * kFlatPixel));
}

/// Corners around a hub, by angle; every second fan has its corners on pixel centres, so that edges and centres meet.
std::vector<Position> fanPositions(Random& random, bool onCentres) {
    const auto placed = [onCentres](double pixels) { return onCentres ? std::floor(pixels) + 0.5 : pixels; };
    const double hubX = random.uniform(20, 76);
    const double hubY = random.uniform(20, 76);
    const double reach = std::exp2(random.uniform(-1, 9));
    std::vector<double> angles;
    const std::uint64_t count = 3 + random.below(60);
    // The first three keep every gap under half a turn.
    for (std::uint64_t i = 0; i < count; ++i)
        angles.push_back(i < 3 ? 2.1 * static_cast<double>(i) : random.uniform(0, 6.28));
    std::sort(angles.begin(), angles.end());
    std::vector<Position> positions = {{cells(placed(hubX)), cells(placed(hubY)), kSceneCenter + (1U << 18U)}};
    for (const double angle : angles) {
        const double radius = reach * random.uniform(0.3, 1);
        positions.push_back(
            {cells(placed(placed(hubX) + radius * std::cos(angle))),
             cells(placed(placed(hubY) + radius * std::sin(angle))),
             kSceneCenter + static_cast<std::uint32_t>(random.below(1U << 20U))});
    }
    return positions;
}

std::size_t coverageIndex(int x, int y) {
    return static_cast<std::size_t>(y) * kCoverageSide + static_cast<std::size_t>(x);
}

/// How often each pixel is covered, drawing one triangle at a time.
std::vector<int> covers(const std::vector<Position>& positions, const View& view, bool cutsDepth) {
    std::vector<int> count(std::size_t{kCoverageSide} * kCoverageSide);
    Rasterizer rasterizer;
    const std::size_t outer = positions.size() - 1;
    for (std::size_t i = 0; i < outer; ++i) {
        Scene scene;
        // Either winding, and the edge shared with the next triangle in either direction.
        const bool turned = i % 3 == 0;
        const auto& a = positions[1 + i];
        const auto& b = positions[1 + (i + 1) % outer];
        scene.add({positions[0], turned ? b : a, turned ? a : b}, {{0, 1, 2}});
        std::vector<std::uint64_t> words(count.size());
        std::vector<float> depths(count.size());
        if (cutsDepth)
            rasterizer.drawVisibility(scene.clusters(), view, {words.data(), kCoverageSide, kCoverageSide});
        else
            rasterizer.drawDepth(scene.clusters(), view, {depths.data(), kCoverageSide, kCoverageSide});
        for (std::size_t p = 0; p < count.size(); ++p)
            count[p] += (cutsDepth ? words[p] != 0 : depths[p] < 1) ? 1 : 0;
    }
    return count;
}

/// Twice the winding of the snapped outline about a pixel centre; 1 where the centre lies on it.
int doubleWinding(const std::vector<SnappedVertex>& outline, std::int64_t x, std::int64_t y) {
    int winding = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const SnappedVertex& a = outline[i];
        const SnappedVertex& b = outline[(i + 1) % outline.size()];
        const std::int64_t side = std::int64_t{b.x - a.x} * (y - a.y) - std::int64_t{b.y - a.y} * (x - a.x);
        const bool within =
            std::min(a.x, b.x) <= x && x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= y && y <= std::max(a.y, b.y);
        if (side == 0 && within) return 1;
        if (a.y <= y && b.y > y && side > 0) winding += 2;
        if (a.y > y && b.y <= y && side < 0) winding -= 2;
    }
    return winding;
}

/// Rounding to pixel centres may fold a fan over itself.
bool isFolded(const SnappedVertex& hub, const std::vector<SnappedVertex>& outline) {
    for (std::size_t i = 0; i < outline.size(); ++i)
        if (doubleArea({hub, outline[i], outline[(i + 1) % outline.size()]}) < 0) return true;
    return false;
}

TEST(Coverage, EachPixelOfAClosedFanIsCoveredOnce) {
    Random random(11);
    int fans = 0;
    const View view = flatView(kCoverageViewport);
    const Projection pass = projection(view, false);
    int inside = 0;
    for (int fan = 0; fan < 300; ++fan) {
        const std::vector<Position> positions = fanPositions(random, fan % 2 == 0);
        std::vector<SnappedVertex> outline;
        for (std::size_t i = 1; i < positions.size(); ++i)
            outline.push_back(snapped(pass, clipPosition(pass, positions[i].data())));
        if (isFolded(snapped(pass, clipPosition(pass, positions[0].data())), outline)) continue;
        ++fans;
        const std::vector<int> count = covers(positions, view, false);
        for (int y = 0; y < kCoverageSide; ++y)
            for (int x = 0; x < kCoverageSide; ++x) {
                const int winding = doubleWinding(outline, std::int64_t{x} * 256, std::int64_t{y} * 256);
                const int covered = count[coverageIndex(x, y)];
                ASSERT_LE(covered, (winding + 1) / 2) << fan << ": " << x << ", " << y;
                ASSERT_GE(covered, winding / 2) << fan << ": " << x << ", " << y;
                inside += covered;
            }
    }
    EXPECT_GT(fans, 150);
    EXPECT_GT(inside, 100000);
}

/// How many of nine points within 1/64 pixel of a centre some triangle covers.
int coveredNearby(const std::vector<HomogeneousTriangle>& triangles, int x, int y, bool cutsDepth) {
    int covered = 0;
    for (const double dx : {-1.0, 0.0, 1.0})
        for (const double dy : {-1.0, 0.0, 1.0})
            covered += std::any_of(triangles.begin(), triangles.end(), [&](const HomogeneousTriangle& triangle) {
                const auto depth = triangle.depth(
                    (x + 0.5 + dx / 64) * 2 / kCoverageSide - 1, (y + 0.5 + dy / 64) * 2 / kCoverageSide - 1);
                return depth && (cutsDepth ? *depth >= 0 && *depth <= 1 : *depth < 1);
            });
    return covered;
}

/// A flat fan stays a fan in perspective: cut by the near plane and by the eye's own plane, it has neither hole nor
/// seam.
TEST(Coverage, EachPixelOfACutFanIsCoveredOnce) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    Random random(12);
    int inside = 0;
    for (std::uint64_t fan = 0; fan < 120; ++fan) {
        const View view = insideView(kCoverageViewport, fan);
        std::vector<Position> positions = fanPositions(random, false);
        for (Position& position : positions)
            position[2] = positions[0][2];
        Scene scene;
        std::vector<Triangle> triangles;
        for (std::size_t i = 1; i < positions.size(); ++i)
            triangles.push_back(
                {0, static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i % (positions.size() - 1) + 1)});
        scene.add(positions, triangles);
        const std::vector<Cluster> clusters = scene.clusters();
        std::vector<HomogeneousTriangle> exact;
        for (std::uint32_t i = 0; i < triangles.size(); ++i)
            exact.emplace_back(clusters.front(), i, view);
        for (const bool cutsDepth : {false, true}) {
            const std::vector<int> count = covers(positions, view, cutsDepth);
            for (int p = 0; p < kCoverageSide * kCoverageSide; ++p) {
                const int expected = coveredNearby(exact, p % kCoverageSide, p / kCoverageSide, cutsDepth);
                const int covered = count[static_cast<std::size_t>(p)];
                ASSERT_LE(covered, expected == 0 ? 0 : 1)
                    << fan << ": " << p % kCoverageSide << ", " << p / kCoverageSide;
                ASSERT_GE(covered, expected == 9 ? 1 : 0)
                    << fan << ": " << p % kCoverageSide << ", " << p / kCoverageSide;
                inside += covered;
            }
        }
    }
    EXPECT_GT(inside, 50000);
}

} // namespace
} // namespace gnomon::raster
