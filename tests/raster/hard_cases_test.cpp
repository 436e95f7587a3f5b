// The hard cases of rasterising, one check each; docs/hard_cases.md shows this table.
#include "tests/raster/flat_depths.h"
#include "tests/raster/homogeneous_triangle.h"
#include "tests/raster/scenes.h"
#include "tests/support/hard_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::raster {
namespace {

/// How often the triangles of a scene cover each pixel, each drawn alone.
std::vector<int> covers(const Scene& scene, const View& view) {
    std::vector<int> count(std::size_t{kFlatSide} * kFlatSide);
    for (const Cluster& cluster : scene.clusters())
        for (std::size_t i = 0; i < cluster.triangles.size(); ++i) {
            Cluster one = cluster;
            one.triangles = cluster.triangles.subspan(i, 1);
            std::vector<float> depths(count.size());
            Rasterizer().drawDepth({&one, 1}, view, {depths.data(), kFlatSide, kFlatSide});
            for (std::size_t p = 0; p < count.size(); ++p)
                count[p] += depths[p] < 1 ? 1 : 0;
        }
    return count;
}

/// A closed fan about `hub` that reaches beyond the viewport everywhere.
Scene wideFan(const Position& hub, int triangles) {
    std::vector<Position> positions = {hub};
    std::vector<Triangle> fan;
    for (int i = 0; i < triangles; ++i) {
        const double angle = 6.283185307 * i / triangles;
        positions.push_back(at(32 + 200 * std::cos(angle), 32 + 200 * std::sin(angle), 0.5));
        fan.push_back({0, static_cast<std::uint8_t>(1 + i), static_cast<std::uint8_t>(1 + (i + 1) % triangles)});
    }
    Scene scene;
    scene.add(positions, fan);
    return scene;
}

/// How many of nine points at and around (x, y), a 64th of a pixel apart, some triangle covers.
int hitsAround(const std::vector<HomogeneousTriangle>& triangles, double x, double y) {
    int hits = 0;
    for (const double dx : {-1.0, 0.0, 1.0})
        for (const double dy : {-1.0, 0.0, 1.0})
            hits += std::any_of(triangles.begin(), triangles.end(), [&](const HomogeneousTriangle& triangle) {
                const auto depth = triangle.depth((x + dx / 64) * 2 / kFlatSide - 1, (y + dy / 64) * 2 / kFlatSide - 1);
                return depth && *depth < 1;
            });
    return hits;
}

/// Pixels that differ from the triangles' coverage in homogeneous space, away from their edges; not a number counts.
std::size_t wrongPixels(const Scene& scene, const View& view) {
    const std::vector<float> depths = flatDepths(scene, view);
    std::vector<HomogeneousTriangle> exact;
    const std::vector<Cluster> clusters = scene.clusters();
    for (const Cluster& cluster : clusters)
        for (std::uint32_t i = 0; i < cluster.triangles.size(); ++i)
            exact.emplace_back(cluster, i, view);
    std::size_t wrong = 0;
    for (int y = 0; y < kFlatSide; ++y)
        for (int x = 0; x < kFlatSide; ++x) {
            const int hits = hitsAround(exact, x + 0.5, y + 0.5);
            const float depth = depths[static_cast<std::size_t>(y) * kFlatSide + static_cast<std::size_t>(x)];
            const bool isWrong = (hits == 9 && depth == 1) || (hits == 0 && depth < 1);
            wrong += isWrong || !(depth >= 0 && depth <= 1) ? 1U : 0U;
        }
    return wrong;
}

void noArea() {
    EXPECT_EQ(covered(flatDepths(at(1, 1, 0.5), at(30, 30, 0.5), at(60, 60, 0.5))), 0U);
    EXPECT_EQ(covered(flatDepths(at(5.5, 5.5, 0.5), at(5.5, 5.5, 0.1), at(5.5, 5.5, 0.9))), 0U);
}

void onePixel() {
    EXPECT_EQ(covered(flatDepths(at(7.3, 9.3, 0.25), at(7.9, 9.4, 0.25), at(7.4, 9.9, 0.25))), 1U);
    EXPECT_EQ(covered(flatDepths(at(7.6, 9.6, 0.25), at(8.4, 9.7, 0.25), at(8.1, 10.4, 0.25))), 0U);
}

void largerThanTheScreen() {
    for (const double size : {200.0, 30000.0, 500000.0}) {
        const auto depths = flatDepths(at(-size, -size, 0.5), at(3 * size, -size, 0.5), at(-size, 3 * size, 0.5));
        EXPECT_EQ(covered(depths), depths.size()) << size;
    }
}

void behindTheEye() {
    for (std::uint64_t seed = 0; seed < 4; ++seed)
        EXPECT_EQ(wrongPixels(soup(24, seed), insideView(kFlatViewport, seed)), 0U) << seed;
}

void throughNear() {
    // One corner before the eye, two behind it: what is left is no triangle.
    View view = flatView(kFlatViewport);
    view.clipFromCell = glm::mat4(0);
    view.clipFromCell[0][0] = view.clipFromCell[1][1] = 0x1p-12F;
    view.clipFromCell[2][3] = 0x1p-20F;
    view.clipFromCell[3][2] = 0x1p-24F;
    Scene scene;
    scene.add({at(0, 0, 0.5), at(300, 40, -0.5), at(-300, 40, -0.25)}, {{0, 1, 2}});
    EXPECT_EQ(wrongPixels(scene, view), 0U);
}

void behindAWarp() {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        View view = flatView(kFlatViewport);
        view.clipFromCell[1][3] = 1.0F / static_cast<float>(40U * kFlatPixel);
        view.clipFromCell[3][3] = 1;
        view.clipFromCell[3][1] = -0.5F;
        EXPECT_EQ(wrongPixels(soup(24, seed), view), 0U) << seed;
    }
}

void cornersOnCentres() {
    const std::vector<int> count = covers(wideFan(at(20.5, 31.5, 0.5), 8), flatView(kFlatViewport));
    EXPECT_EQ(std::count(count.begin(), count.end(), 1), kFlatSide * kFlatSide);
}

void manyShareACorner() {
    for (const double offset : {0.0, 0.5, 0.25, 1.0 / 256, 0.3}) {
        const std::vector<int> count = covers(wideFan(at(32 + offset, 32 - offset, 0.5), 85), flatView(kFlatViewport));
        EXPECT_EQ(std::count(count.begin(), count.end(), 1), kFlatSide * kFlatSide) << offset;
    }
}

void clampedDepth() {
    constexpr std::size_t kMiddle = std::size_t{32} * kFlatSide;
    // From depth -1 on the left to 2 on the right: the middle third keeps its slope.
    const auto depths = flatDepths(at(0, -64, -1), at(0, 128, -1), at(192, 32, 8));
    EXPECT_EQ(depths[kMiddle], 0.0F);
    EXPECT_NEAR(depths[kMiddle + 31], -1 + 3 * 31.5 / 64, 1e-5);
    EXPECT_EQ(depths[kMiddle + 63], 1.0F);
}

void steepSlope() {
    // 0.09 of depth a pixel: snapping alone would shift it by up to 1.8e-4. Corners lie at odd 1/1024 pixels.
    const auto depthAt = [](double x) { return 0.1 + 0.09 * x; };
    const double x0 = 1 + 1.0 / 1024;
    const double x1 = 9 + 513.0 / 1024;
    const auto depths = flatDepths(at(x0, 1, depthAt(x0)), at(x0, 60, depthAt(x0)), at(x1, 30, depthAt(x1)));
    EXPECT_NEAR(depths[30 * kFlatSide + 4], depthAt(4.5), 5e-6);
    EXPECT_NEAR(depths[20 * kFlatSide + 3], depthAt(3.5), 5e-6);
}

void sliverOfSnapping() {
    // Less than 1/256 pixel wide, snapped to a whole one: the plane through its own corners would be arbitrary.
    for (double width = 0; width < 1.0 / 256; width += 1.0 / 4096) {
        const auto depths = flatDepths(
            at(10.5 - 1.0 / 512, 2, 0.25), at(10.5 - 1.0 / 512 + width, 60, 0.75), at(10.5 + 0.0021, 61, 0.75));
        for (const float depth : depths)
            ASSERT_TRUE(depth == 1 || (depth >= 0.25F && depth <= 0.75F)) << width;
    }
}

/// The boxes of the scene's clusters.
std::vector<CellBox> boxesOf(const Scene& scene) {
    std::vector<CellBox> boxes;
    for (const Cluster& cluster : scene.clusters()) {
        CellBox& box = boxes.emplace_back();
        box.min.fill(0xFFFFFFFFU);
        for (std::size_t i = 0; i < 3 * std::size_t{cluster.vertexCount}; ++i) {
            box.min[i % 3] = std::min(box.min[i % 3], cluster.positions[i]);
            box.max[i % 3] = std::max(box.max[i % 3], cluster.positions[i]);
        }
    }
    return boxes;
}

/// How many clusters go undrawn; the words are those of all.
std::uint64_t hiddenIn(const Scene& scene, const View& view = flatView(kFlatViewport)) {
    std::vector<std::uint64_t> all(std::size_t{kFlatSide} * kFlatSide);
    std::vector<std::uint64_t> seen(all.size());
    Rasterizer rasterizer;
    rasterizer.drawVisibility(scene.clusters(), view, {all.data(), kFlatSide, kFlatSide});
    const OcclusionCounts counts =
        rasterizer.drawVisible(scene.clusters(), boxesOf(scene), view, {seen.data(), kFlatSide, kFlatSide});
    EXPECT_TRUE(seen == all);
    return counts.clustersHidden;
}

void addQuad(Scene& scene, double x0, double y0, double x1, double y1, double depth) {
    scene.add({at(x0, y0, depth), at(x1, y0, depth), at(x0, y1, depth), at(x1, y1, depth)}, {{0, 1, 2}, {3, 2, 1}});
}

void pinhole() {
    for (const double hole : {0.0, 1.0}) {
        Scene scene;
        addQuad(scene, 10, 10, 50, 50, 0.25);
        addQuad(scene, 0, 0, 30, 64, 0.75);
        addQuad(scene, 30 + hole, 0, 64, 64, 0.75);
        addQuad(scene, 29, 0, 32, 30, 0.75);
        addQuad(scene, 29, 30 + hole, 32, 64, 0.75);
        EXPECT_EQ(hiddenIn(scene), hole > 0 ? 0U : 1U) << hole;
    }
}

void asFarAsWhatIsDrawn() {
    Scene scene;
    addQuad(scene, 20, 20, 40, 40, 0.5); // smaller, and first in the list: it owns its pixels
    addQuad(scene, 0, 0, 64, 64, 0.5);
    addQuad(scene, 10, 10, 30, 30, 0.5);
    EXPECT_EQ(hiddenIn(scene), 0U);
}

void aroundTheEye() {
    const View view = insideView(kFlatViewport, 3);
    const auto cell = [&](int axis, double pixels) {
        return static_cast<std::uint32_t>(view.eyeCell[axis] + std::llround(pixels * kFlatPixel));
    };
    Scene scene;
    for (const double reach : {40.0, 4000.0, 100.0}) // rooms around the eye, and what lies behind their walls
        for (const double side : {-1.0, 1.0})
            for (int axis = 0; axis < 3; ++axis) {
                std::vector<Position> corners;
                for (const auto& [u, v] : std::vector<std::array<double, 2>>{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}) {
                    std::array<double, 3> p{};
                    p[static_cast<std::size_t>(axis)] = side * reach;
                    p[static_cast<std::size_t>((axis + 1) % 3)] = u * reach;
                    p[static_cast<std::size_t>((axis + 2) % 3)] = v * reach;
                    corners.push_back({cell(0, p[0]), cell(1, p[1]), cell(2, p[2])});
                }
                scene.add(corners, {{0, 1, 2}, {3, 2, 1}});
            }
    hiddenIn(scene, view);
}

constexpr std::array kCases = {
    HardCase{
        "a triangle of no area", "a division by twice its area; a pixel centre on its line counts as inside", noArea},
    HardCase{
        "a triangle smaller than a pixel", "conservative bounds or rounding draw a pixel too many, or none", onePixel},
    HardCase{
        "a triangle a thousand times larger than the screen", "edge functions overflow 32 bits", largerThanTheScreen},
    HardCase{"triangles behind the eye", "the division by w < 0 mirrors them onto the screen", behindTheEye},
    HardCase{
        "two corners behind the eye and one before it",
        "the projected corners enclose the wrong side, and the outside of the triangle is drawn",
        throughNear},
    HardCase{
        "w <= 0 under a warp",
        "geometry behind the warp's centre of projection appears mirrored in the map",
        behindAWarp},
    HardCase{
        "corners and edges on pixel centres",
        "inclusive tests cover a centre from both sides, and exclusive tests from none",
        cornersOnCentres},
    HardCase{
        "85 triangles that share a corner",
        "inexact edges leave holes around the corner, or cover pixels twice",
        manyShareACorner},
    HardCase{
        "a caster that leaves the depth range",
        "clamped corners change its depth slope; clipped, it casts no shadow",
        clampedDepth},
    HardCase{
        "a steep triangle between snapped corners",
        "its depth plane moves with the corners, by up to slope / 512",
        steepSlope},
    HardCase{
        "a sliver that only snapping gave an area",
        "the depth plane through its unsnapped corners is unbounded or NaN",
        sliverOfSnapping},
    HardCase{
        "a hole of one pixel in an occluder",
        "a farthest depth that ignores some pixels of its block closes the hole, and geometry behind it is culled",
        pinhole},
    HardCase{
        "clusters as far as the drawn surface",
        "they are culled although the lower triangle number wins: the order of drawing decides",
        asFarAsWhatIsDrawn},
    HardCase{
        "boxes around the eye",
        "corners divided by w near or below 0 bound nothing, and geometry around the eye is culled",
        aroundTheEye},
};

TEST(HardCases, HoldAndAreInTheDocument) {
    runHardCases(GNOMON_SOURCE_DIR, "Rasterising", kCases);
}

} // namespace
} // namespace gnomon::raster
