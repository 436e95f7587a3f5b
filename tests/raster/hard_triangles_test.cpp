// Triangles that a careless rasteriser draws wrongly, against coverage in homogeneous space.
#include "tests/raster/flat_depths.h"
#include "tests/raster/homogeneous_triangle.h"
#include "tests/raster/plain_raster.h"
#include "tests/raster/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::raster {
namespace {

Scene triangle(std::array<std::uint32_t, 3> a, std::array<std::uint32_t, 3> b, std::array<std::uint32_t, 3> c) {
    Scene scene;
    scene.add({a, b, c}, {{0, 1, 2}});
    return scene;
}

TEST(HardTriangles, NoAreaDrawsNothing) {
    const View view = flatView(kFlatViewport);
    EXPECT_EQ(covered(flatDepths(triangle(at(1, 1, 0.5), at(30, 30, 0.5), at(60, 60, 0.5)), view)), 0U);
    EXPECT_EQ(covered(flatDepths(triangle(at(1.5, 9.5, 0.5), at(60.5, 9.5, 0.5), at(30.5, 9.5, 0.5)), view)), 0U);
    EXPECT_EQ(covered(flatDepths(triangle(at(5.5, 5.5, 0.5), at(5.5, 5.5, 0.1), at(5.5, 5.5, 0.9)), view)), 0U);
}

TEST(HardTriangles, OnePixel) {
    const auto depths =
        flatDepths(triangle(at(7.3, 9.3, 0.25), at(7.9, 9.4, 0.25), at(7.4, 9.9, 0.25)), flatView(kFlatViewport));
    EXPECT_EQ(covered(depths), 1U);
    EXPECT_FLOAT_EQ(depths[pixelIndex(7, 9)], 0.25F);
}

TEST(HardTriangles, LargerThanTheScreenCoversAllOfIt) {
    for (const double size : {200.0, 2000.0, 30000.0, 500000.0}) {
        const auto depths = flatDepths(
            triangle(at(-size, -size, 0.5), at(3 * size, -size, 0.5), at(-size, 3 * size, 0.5)),
            flatView(kFlatViewport));
        EXPECT_EQ(covered(depths), depths.size()) << size;
        for (const float depth : depths)
            ASSERT_NEAR(depth, 0.5F, 1e-6F) << size;
    }
}

TEST(HardTriangles, DepthIsClampedAtPixelsNotAtCorners) {
    // From depth -1 on the left to 2 on the right: the middle third lies in the range and must keep its slope.
    const auto depths = flatDepths(triangle(at(0, -64, -1), at(0, 128, -1), at(192, 32, 8)), flatView(kFlatViewport));
    EXPECT_EQ(depths[pixelIndex(0, 32)], 0.0F);
    EXPECT_NEAR(depths[pixelIndex(31, 32)], -1 + 3 * 31.5 / 64, 1e-5);
    EXPECT_EQ(depths[pixelIndex(63, 32)], 1.0F);
}

TEST(HardTriangles, SharedCornersOnPixelCentresBelongToOne) {
    Scene scene;
    const auto id = [](int x, int y) { return static_cast<std::uint8_t>(9 * y + x); };
    std::vector<std::array<std::uint32_t, 3>> positions;
    std::vector<Triangle> triangles;
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x)
            positions.push_back(at(4.5 + 5 * x, 4.5 + 5 * y, 0.5));
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            triangles.push_back({id(x, y), id(x + 1, y), id(x + 1, y + 1)});
            triangles.push_back({id(x, y), id(x + 1, y + 1), id(x, y + 1)});
        }
    scene.add(positions, triangles);
    std::vector<int> count(std::size_t{kFlatSide} * kFlatSide);
    visitPixels(scene.clusters(), flatView(kFlatViewport), false, [&](int x, int y, float, std::uint32_t) {
        ++count[pixelIndex(x, y)];
    });
    // Left and lowest edges belong to the square: pixels 4 to 43.
    for (int y = 0; y < kFlatSide; ++y)
        for (int x = 0; x < kFlatSide; ++x)
            EXPECT_EQ(count[pixelIndex(x, y)], x >= 4 && x < 44 && y >= 4 && y < 44 ? 1 : 0);
    EXPECT_EQ(covered(flatDepths(scene, flatView(kFlatViewport))), 1600U);
}

/// Whether a triangle is there at all points within 1/64 pixel of a centre, at none, or (nothing) at some.
struct Nearby {
    bool all = true;
    bool none = true;
    double min = 1e30;
    double largest = -1e30;
};

Nearby nearby(const HomogeneousTriangle& triangle, int x, int y, bool cutsDepth) {
    Nearby result;
    for (const double dx : {-1.0, 0.0, 1.0})
        for (const double dy : {-1.0, 0.0, 1.0}) {
            const auto depth =
                triangle.depth((x + 0.5 + dx / 64) * 2 / kFlatSide - 1, (y + 0.5 + dy / 64) * 2 / kFlatSide - 1);
            const bool there = depth && (!cutsDepth || (*depth >= 0 && *depth <= 1));
            result.all = result.all && there;
            result.none = result.none && !there;
            if (there) {
                result.min = std::min(result.min, *depth);
                result.largest = std::max(result.largest, *depth);
            }
        }
    return result;
}

/// Whether what was drawn at a pixel, away from edges, is what must be there.
bool isRight(const Nearby& expected, float depth, bool isDrawn, bool cutsDepth) {
    if (std::isnan(depth)) return false;
    if (cutsDepth && isDrawn != expected.all) return false;
    // A clamped depth of 1 looks like nothing; where depth is less, something is there.
    if (expected.none) return cutsDepth || depth == 1;
    const double slack = 1e-4 + 1e-6 * (expected.largest - expected.min);
    return depth >= std::clamp(expected.min, 0.0, 1.0) - slack &&
           depth <= std::clamp(expected.largest, 0.0, 1.0) + slack;
}

/// Counts the pixels that are wrong when `cluster`, of one triangle, is drawn alone.
int wrongPixels(const Cluster& cluster, const View& view, bool cutsDepth, int& checked) {
    std::vector<float> depths(std::size_t{kFlatSide} * kFlatSide);
    std::vector<std::uint64_t> words(depths.size());
    if (cutsDepth)
        Rasterizer().drawVisibility({&cluster, 1}, view, {words.data(), kFlatSide, kFlatSide});
    else
        Rasterizer().drawDepth({&cluster, 1}, view, {depths.data(), kFlatSide, kFlatSide});
    const HomogeneousTriangle exact(cluster, 0, view);
    int wrong = 0;
    for (int y = 0; y < kFlatSide; ++y)
        for (int x = 0; x < kFlatSide; ++x) {
            const Nearby expected = nearby(exact, x, y, cutsDepth);
            if (expected.all == expected.none) continue;
            const std::size_t i = pixelIndex(x, y);
            const float depth = cutsDepth ? visibleDepth(words[i]) : depths[i];
            ++checked;
            wrong += isRight(expected, depth, words[i] != 0, cutsDepth) ? 0 : 1;
        }
    return wrong;
}

int wrongPixels(const Scene& scene, const View& view, bool cutsDepth, int& checked) {
    int wrong = 0;
    for (const Cluster& cluster : scene.clusters())
        for (std::uint32_t i = 0; i < cluster.triangles.size(); ++i) {
            Cluster one = cluster;
            one.triangles = cluster.triangles.subspan(i, 1);
            wrong += wrongPixels(one, view, cutsDepth, checked);
        }
    return wrong;
}

TEST(HardTriangles, BehindTheEyeAndThroughNearAsInHomogeneousSpace) {
    int checked = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed)
        for (const bool cutsDepth : {false, true})
            EXPECT_EQ(wrongPixels(soup(24, seed), insideView(kFlatViewport, seed), cutsDepth, checked), 0) << seed;
    EXPECT_GT(checked, 100000);
}

TEST(HardTriangles, BehindAWarpsCentreOfProjectionAsInHomogeneousSpace) {
    // A light looking along z whose warp shrinks along x or y: w = 1 + kappa (y - near), negative for what lies far
    // behind. Every warp is of this form, from next to none to a centre of projection amid the map.
    int checked = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        View view = flatView(kFlatViewport);
        constexpr std::array<unsigned, 4> kCentres = {400U, 120U, 40U, 12U}; // pixels behind the map
        const float kappa = 1.0F / static_cast<float>(kCentres[seed % 4] * kFlatPixel);
        view.clipFromCell[seed / 4 % 2 == 0 ? 1 : 0][3] = seed < 8 ? kappa : -kappa;
        view.clipFromCell[3][3] = 1;
        view.clipFromCell[3][1] = -0.5F;
        EXPECT_EQ(wrongPixels(soup(24, seed), view, false, checked), 0) << seed;
    }
    EXPECT_GT(checked, 100000);
}

TEST(HardTriangles, BehindTheEyeDrawsNothing) {
    View view = insideView(kFlatViewport, 1);
    view.eyeCell = glm::ivec3(static_cast<int>(kSceneCenter));
    view.clipFromCell = glm::mat4(0);
    view.clipFromCell[0][0] = view.clipFromCell[1][1] = 1;
    view.clipFromCell[2][3] = 1;
    view.clipFromCell[3][2] = 1;
    EXPECT_EQ(covered(flatDepths(triangle(at(-50, -50, -0.1), at(50, -50, -0.2), at(0, 50, -0.3)), view)), 0U);
    // Edge-on through the eye itself.
    EXPECT_EQ(covered(flatDepths(triangle(at(0, 0, 0), at(50, -50, 0.2), at(50, -50, 0.3)), view)), 0U);
}

} // namespace
} // namespace gnomon::raster
