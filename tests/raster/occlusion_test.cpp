// Drawing from the front to the back without what is hidden, against plain code that draws all of it.
#include "raster/box_bound.h"
#include "raster/buffer.h"
#include "raster/farthest_depths.h"
#include "raster/occlusion_pass.h"
#include "raster/raster.h"
#include "raster/snapped_clusters.h"
#include "tests/raster/plain_raster.h"
#include "tests/raster/scenes.h"
#include "tests/support/each_target.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <set>

namespace gnomon::raster {
namespace {

constexpr int kWidth = 333; // no multiple of anything
constexpr int kHeight = 290;
constexpr PixelBox kOcclusionViewport = {7, 5, 330, 281};

/// How many clusters own a pixel.
std::size_t seenClusters(const std::vector<Cluster>& clusters, const std::vector<std::uint64_t>& words) {
    std::set<std::size_t> seen;
    for (const std::uint64_t word : words) {
        if (word == 0) continue;
        const std::uint32_t name = visibleTriangle(word);
        for (std::size_t i = 0; i < clusters.size(); ++i)
            if (name - clusters[i].firstTriangleId < clusters[i].triangles.size()) seen.insert(i);
    }
    return seen.size();
}

/// The words of plain code on every instruction set and for any number of threads, and always the same counts, which
/// come back.
OcclusionCounts expectSameAsPlain(const std::vector<Cluster>& clusters, const View& view) {
    const std::size_t pixels = std::size_t{kWidth} * kHeight;
    std::vector<std::uint64_t> plain(pixels, 0);
    plainVisibility(clusters, view, {plain.data(), kWidth, kHeight});
    const std::vector<CellBox> boxes = boxesOf(clusters);
    std::optional<OcclusionCounts> first;
    const tbb::global_control sixteen(tbb::global_control::max_allowed_parallelism, 16);
    Rasterizer rasterizer;
    tests::onEachTarget([&](const char* target) {
        for (const int threads : {1, 2, 16}) {
            SCOPED_TRACE(std::string(target) + ", threads " + std::to_string(threads));
            std::vector<std::uint64_t> words(pixels, 0);
            const OcclusionCounts counts = tbb::task_arena(threads).execute([&] {
                return rasterizer.drawVisible(clusters, boxes, view, {words.data(), kWidth, kHeight});
            });
            EXPECT_TRUE(words == plain);
            if (!first) first = counts;
            EXPECT_EQ(counts, *first);
        }
    });
    EXPECT_LE(first->clustersHidden, clusters.size() - seenClusters(clusters, plain));
    return *first;
}

/// The depths of plain code likewise, in a map.
OcclusionCounts expectSameDepths(const std::vector<Cluster>& clusters, const View& view) {
    const std::size_t pixels = std::size_t{kWidth} * kHeight;
    constexpr float kUntouched = 2;
    std::vector<float> plain(pixels, kUntouched);
    plainDepth(clusters, view, {plain.data(), kWidth, kHeight});
    const std::vector<CellBox> boxes = boxesOf(clusters);
    std::optional<NearestDepths> first;
    const tbb::global_control sixteen(tbb::global_control::max_allowed_parallelism, 16);
    Rasterizer rasterizer;
    tests::onEachTarget([&](const char* target) {
        for (const int threads : {1, 2, 16}) {
            SCOPED_TRACE(std::string(target) + ", threads " + std::to_string(threads));
            std::vector<float> depths(pixels, kUntouched);
            const NearestDepths drawn = tbb::task_arena(threads).execute([&] {
                return rasterizer.drawNearestDepth(clusters, boxes, view, {depths.data(), kWidth, kHeight});
            });
            EXPECT_TRUE(depths == plain);
            if (!first) first = drawn;
            EXPECT_EQ(drawn.hidden, first->hidden);
            EXPECT_EQ(drawn.fragments, first->fragments);
        }
    });
    return first->hidden;
}

TEST(Occlusion, SheetsOfEverySizeOfTriangle) {
    for (const double spacing : {0.3, 1.4, 4.0, 11.0, 40.0, 150.0}) {
        SCOPED_TRACE(spacing);
        const int quads = static_cast<int>(std::min(120.0, std::ceil(kWidth / spacing) + 1));
        const Scene scene = sheet(quads, quads, spacing, 3);
        expectSameAsPlain(scene.clusters(), flatView(kOcclusionViewport));
    }
}

TEST(Occlusion, CrowdsSeenFromAmongThem) {
    std::uint64_t hidden = 0;
    std::uint64_t hiddenInMaps = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        SCOPED_TRACE(seed);
        const Scene scene = crowd(seed);
        hidden += expectSameAsPlain(scene.clusters(), insideView(kOcclusionViewport, seed)).clustersHidden;
        hiddenInMaps += expectSameDepths(scene.clusters(), insideView(kOcclusionViewport, seed)).clustersHidden;
        hiddenInMaps += expectSameDepths(scene.clusters(), flatView(kOcclusionViewport)).clustersHidden;
    }
    EXPECT_GT(hidden, 50U);
    EXPECT_GT(hiddenInMaps, 50U);
}

TEST(Occlusion, SoupsSeenFromAmongThem) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        SCOPED_TRACE(seed);
        const Scene scene = soup(1500, seed);
        expectSameAsPlain(scene.clusters(), insideView(kOcclusionViewport, seed));
        expectSameDepths(scene.clusters(), insideView(kOcclusionViewport, seed));
    }
}

TEST(SlowOcclusion, CrowdsAndSoupsSeenFromAmongThem) {
    std::uint64_t hidden = 0;
    for (std::uint64_t seed = 100; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        const Scene scene = seed % 4 == 0 ? soup(1000, seed) : crowd(seed);
        hidden += expectSameAsPlain(scene.clusters(), insideView(kOcclusionViewport, seed)).clustersHidden;
        expectSameDepths(scene.clusters(), insideView(kOcclusionViewport, seed));
    }
    EXPECT_GT(hidden, 1000U);
}

/// A square of `quads` x `quads` quads over pixels [x, x + side) and [y, y + side), at a depth of 0 to 1.
void addSquare(Scene& scene, double x, double y, double side, double depth, int quads = 8) {
    std::vector<std::array<std::uint32_t, 3>> positions;
    std::vector<Triangle> triangles;
    const auto cells = [](double value) { return kSceneCenter + static_cast<std::uint32_t>(std::llround(value)); };
    for (int row = 0; row <= quads; ++row)
        for (int column = 0; column <= quads; ++column)
            positions.push_back(
                {cells((x + side * column / quads) * kFlatPixel),
                 cells((y + side * row / quads) * kFlatPixel),
                 cells(depth * 0x1p20)});
    const auto at = [quads](int column, int row) { return static_cast<std::uint8_t>(row * (quads + 1) + column); };
    for (int row = 0; row < quads; ++row)
        for (int column = 0; column < quads; ++column) {
            triangles.push_back({at(column, row), at(column + 1, row), at(column, row + 1)});
            triangles.push_back({at(column + 1, row + 1), at(column + 1, row), at(column, row + 1)});
        }
    scene.add(std::move(positions), std::move(triangles));
}

TEST(Occlusion, LeavesOutAllThatAWallHides) {
    Scene scene;
    for (int i = 0; i < 50; ++i) // behind: depths are reversed
        addSquare(scene, 20 + 5 * i, 10 + 3 * i, 40, 0.1 + 0.01 * i);
    addSquare(scene, -50, -50, 500, 0.75, 1);
    const OcclusionCounts counts = expectSameAsPlain(scene.clusters(), flatView(kOcclusionViewport));
    EXPECT_EQ(counts.clustersHidden, 50U);
    EXPECT_EQ(counts.trianglesHidden, 50U * 128U);
}

// In a map the least depth is the nearest, and all that lies before its range is as near as its begin.
TEST(Occlusion, OfMapsLeavesOutAllThatASlabHides) {
    for (const double slab : {0.05, -0.5}) {
        Scene scene;
        for (int i = 0; i < 50; ++i)
            addSquare(scene, 20 + 5 * i, 10 + 3 * i, 40, 0.1 + 0.01 * i);
        for (int i = 0; i < 5; ++i)
            addSquare(scene, 20 + 5 * i, 10 + 3 * i, 40, -0.1 - 0.01 * i);
        addSquare(scene, -50, -50, 500, slab, 1);
        std::vector<Cluster> clusters = scene.clusters();
        EXPECT_EQ(expectSameDepths(clusters, flatView(kOcclusionViewport)).clustersHidden, 50U) << slab;
        std::rotate(clusters.begin(), clusters.end() - 1, clusters.end());
        EXPECT_EQ(expectSameDepths(clusters, flatView(kOcclusionViewport)).clustersHidden, slab < 0 ? 55U : 50U)
            << "whoever comes first of those before the map hides the others";
    }
}

TEST(Occlusion, AHoleOfOnePixelIsSeenThrough) {
    for (const double hole : {140, 143, 148}) // about a block's border, and in its middle
        for (const double side : {5, 12, 20, 40, 70, 110, 500}) {
            SCOPED_TRACE(std::to_string(hole) + ", " + std::to_string(side));
            Scene scene;
            addSquare(scene, hole - 0.4 * side, hole - 0.4 * side, side, 0.25, 1);
            addSquare(scene, hole - 450, -300, 450, 0.75, 1);
            addSquare(scene, hole + 1, -300, 600, 0.75, 1);
            addSquare(scene, hole - 100, hole + 1, 300, 0.75, 1);
            addSquare(scene, hole - 100, hole - 300, 300, 0.75, 1); // between them is one pixel
            EXPECT_EQ(expectSameAsPlain(scene.clusters(), flatView(kOcclusionViewport)).clustersHidden, 0U);
            expectSameDepths(scene.clusters(), flatView(kOcclusionViewport));
        }
}

TEST(Occlusion, EqualDepthsGoToTheFirstInTheListWhateverIsDrawnFirst) {
    Scene scene;
    addSquare(scene, 100, 100, 60, 0.5); // larger boxes are no nearer, and do not win
    addSquare(scene, 0, 0, 300, 0.5);
    addSquare(scene, 90, 90, 100, 0.5, 2);
    expectSameAsPlain(scene.clusters(), flatView(kOcclusionViewport));
    std::vector<Cluster> reversed = scene.clusters();
    std::reverse(reversed.begin(), reversed.end());
    expectSameAsPlain(reversed, flatView(kOcclusionViewport));
}

TEST(Occlusion, NothingAtAll) {
    EXPECT_EQ(expectSameAsPlain({}, flatView(kOcclusionViewport)), OcclusionCounts());
    EXPECT_EQ(expectSameDepths({}, flatView(kOcclusionViewport)), OcclusionCounts());
}

TEST(BoxBound, HoldsEveryPixelAndDepthOfVerticesInTheBox) {
    Random random(5);
    std::size_t wholeBoxes = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const Projection pass = projection(insideView(kOcclusionViewport, static_cast<std::uint64_t>(trial)), true);
        CellBox box;
        const double size = kFlatPixel * std::exp2(random.uniform(-4, 10));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double middle = kSceneCenter + random.uniform(-100, 400) * kFlatPixel;
            box.min[axis] = static_cast<std::uint32_t>(middle);
            box.max[axis] = box.min[axis] + static_cast<std::uint32_t>(random.uniform(0, 1) * size);
        }
        const BoxBound bound = boxBound(pass, box);
        if (!bound.isWhole) continue;
        ++wholeBoxes;
        for (unsigned corner = 0; corner < 16; ++corner) {
            std::array<std::uint32_t, 3> position{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto reach = box.max[axis] - box.min[axis];
                const bool isUpper = (corner >> axis & 1U) != 0;
                position[axis] = corner < 8 ? (isUpper ? box.max[axis] : box.min[axis])
                                            : box.min[axis] + static_cast<std::uint32_t>(random.below(reach + 1U));
            }
            const ClipPosition p = clipPosition(pass, position.data());
            ASSERT_GE(p.w, kMinW);
            ASSERT_LE(std::abs(p.x), pass.guardX * p.w);
            ASSERT_LE(std::abs(p.y), pass.guardY * p.w);
            ASSERT_EQ(outsideBits(pass, p) & 48U, 0U);
            const SnappedVertex v = snapped(pass, p);
            ASSERT_LE(v.z, bound.nearest);
            ASSERT_GE(v.z, bound.min);
            ASSERT_GE(v.x, (bound.box.x0 - 1) * kSubpixels);
            ASSERT_LE(v.x, bound.box.x1 * kSubpixels);
            ASSERT_GE(v.y, (bound.box.y0 - 1) * kSubpixels);
            ASSERT_LE(v.y, bound.box.y1 * kSubpixels);
            // No pixel centre that it may take lies outside.
            ASSERT_GE((v.x + kSubpixels - 1) >> kSubpixelBits, bound.box.x0);
            ASSERT_LT(v.x >> kSubpixelBits, bound.box.x1);
            ASSERT_GE((v.y + kSubpixels - 1) >> kSubpixelBits, bound.box.y0);
            ASSERT_LT(v.y >> kSubpixelBits, bound.box.y1);
        }
    }
    EXPECT_GT(wholeBoxes, 400U);
}

TEST(BoxBound, IsCloseAroundWhatIsFarFromTheEye) {
    const View view = flatView(kOcclusionViewport);
    CellBox box;
    box.min = {kSceneCenter + 100 * kFlatPixel, kSceneCenter + 40 * kFlatPixel, kSceneCenter + (1U << 18U)};
    box.max = {kSceneCenter + 120 * kFlatPixel, kSceneCenter + 43 * kFlatPixel, kSceneCenter + (1U << 19U)};
    const BoxBound bound = boxBound(projection(view, true), box);
    ASSERT_TRUE(bound.isWhole);
    EXPECT_EQ(bound.box, (PixelBox{107, 45, 127, 48}));
    EXPECT_NEAR(bound.nearest, 0.5, 1e-5);
    EXPECT_NEAR(bound.min, 0.25, 1e-5);
    box.max[2] = kSceneCenter + (1U << 20U) + 1; // past the near plane
    EXPECT_FALSE(boxBound(projection(view, true), box).isWhole);
    EXPECT_TRUE(boxBound(projection(view, false), box).isWhole) << "a map cuts nothing off";
}

TEST(FarthestDepths, AreThoseOfAllPixels) {
    constexpr int kSide = 100; // no multiple of a block
    std::vector<std::uint64_t> words(kTilePixels, 0);
    const auto wordAt = [&](int x, int y) -> std::uint64_t& {
        return words[static_cast<std::size_t>(y) * kTileStride + static_cast<std::size_t>(x)];
    };
    FarthestDepths<WordDepths> depths(words.data(), kSide, kSide);
    Random random(3);
    const auto randomBox = [&] {
        const int x = static_cast<int>(random.below(kSide));
        const int y = static_cast<int>(random.below(kSide));
        const auto reach = static_cast<std::uint64_t>(1) << random.below(7);
        return PixelBox{
            x,
            y,
            std::min(kSide, x + 1 + static_cast<int>(random.below(reach))),
            std::min(kSide, y + 1 + static_cast<int>(random.below(reach)))};
    };
    int hiddenCount = 0;
    for (int step = 0; step < 3000; ++step) {
        const PixelBox drawn = randomBox();
        const auto depth = static_cast<float>(random.uniform(0, 1));
        for (int y = drawn.y0; y < drawn.y1; ++y)
            for (int x = drawn.x0; x < drawn.x1; ++x)
                wordAt(x, y) = std::max(wordAt(x, y), visibilityWord(depth, 7));
        depths.noteDrawn(drawn);
        const PixelBox asked = randomBox();
        std::uint64_t min = ~std::uint64_t{0};
        for (int y = asked.y0; y < asked.y1; ++y)
            for (int x = asked.x0; x < asked.x1; ++x)
                min = std::min(min, wordAt(x, y));
        const float farthest = visibleDepth(min);
        const auto before = std::bit_cast<float>(std::bit_cast<std::uint32_t>(farthest) - 1);
        if (farthest > 0) {
            EXPECT_TRUE(depths.hides(asked, reversedNearness(before)));
            ++hiddenCount;
        }
        EXPECT_FALSE(depths.hides(asked, reversedNearness(farthest))); // as far as the farthest: ties are not hidden
    }
    EXPECT_GT(hiddenCount, 100);
}

TEST(OcclusionOrder, SortsByUpperHalvesAndKeepsTheRest) {
    Random random(9);
    std::vector<std::uint64_t> keys;
    for (std::uint64_t i = 0; i < 5000; ++i)
        keys.push_back(random.below(random.below(2) == 0 ? 40 : 0x3F800001) << 32U | i);
    std::vector<std::uint64_t> expected = keys;
    std::sort(expected.begin(), expected.end());
    std::vector<std::uint64_t> scratch;
    sortByUpperHalf(keys, scratch);
    EXPECT_EQ(keys, expected);
}

TEST(SnappedClusters, AreSnappedOneByOneAndTheOthersEmpty) {
    const Scene scene = sheet(20, 20, 4, 1);
    const std::vector<Cluster> clusters = scene.clusters();
    SnappedClusters snapped;
    snapped.reset(clusters);
    EXPECT_EQ(snapped.snap(clusters, 3, projection(flatView(kOcclusionViewport), true)), ClusterPlace::Inside);
    snapped.addCuts();
    ASSERT_EQ(snapped.all().size(), clusters.size());
    for (std::size_t i = 0; i < clusters.size(); ++i)
        EXPECT_EQ(snapped.all()[i].triangles.empty(), i != 3);
    const SnappedCluster& one = snapped.all()[3];
    EXPECT_EQ(one.maxZ, *std::max_element(one.vertices.z, one.vertices.z + one.vertexCount));
}

TEST(Buffer, GrowsAndStays) {
    Buffer<int> buffer;
    int* const small = buffer.reserve(10);
    EXPECT_EQ(buffer.reserve(5), small);
    EXPECT_NE(buffer.reserve(1000), nullptr);
}

} // namespace
} // namespace gnomon::raster
