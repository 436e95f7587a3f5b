// One tile drawn by itself, against plain code over the tile's pixels, on every instruction set.
#include "core/random.h"
#include "raster/prefetch.h"
#include "raster/tile_kernel.h"
#include "raster/tile_work.h"
#include "raster/vertex_kernel.h"
#include "tests/raster/plain_raster.h"
#include "tests/raster/scenes.h"
#include "tests/support/each_target.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <deque>
#include <optional>

namespace gnomon::raster {
namespace {

constexpr PixelBox kTileViewport = {0, 0, 400, 300};

/// The clusters of a scene that need no cutting, snapped as the rasteriser snaps them.
struct SnappedScene {
    SnappedScene(const std::vector<Cluster>& clusters, const Projection& pass) {
        for (const Cluster& cluster : clusters) {
            Arrays& arrays = storage.emplace_back(paddedVertexCount(cluster.vertexCount));
            const VertexStage stage = snapVertices(pass, cluster, arrays.all());
            if (stage.place != ClusterPlace::Inside) continue;
            SnappedCluster snapped;
            snapped.vertices = arrays.all();
            snapped.isCompact = stage.isCompact;
            snapped.triangles = cluster.triangles;
            snapped.vertexCount = cluster.vertexCount;
            snapped.firstTriangleId = cluster.firstTriangleId;
            snapped.box = stage.box;
            indices.push_back(static_cast<std::uint32_t>(all.size()));
            all.push_back(snapped);
            kept.push_back(cluster);
        }
    }

    struct Arrays {
        explicit Arrays(std::size_t count) : x(count), y(count), z(count), rests(count) {}

        SnappedArrays all() { return {x.data(), y.data(), z.data(), rests.data()}; }

        std::vector<std::int32_t> x, y;
        std::vector<float> z;
        std::vector<std::uint32_t> rests;
    };

    std::deque<Arrays> storage;
    std::vector<SnappedCluster> all;
    std::vector<std::uint32_t> indices;
    std::vector<Cluster> kept;
};

std::size_t inTile(int x, int y) {
    return static_cast<std::size_t>(y) * kTileStride + static_cast<std::size_t>(x);
}

/// What the tile must hold, pixel by pixel.
struct PlainTile {
    PlainTile(const std::vector<Cluster>& clusters, const View& view, const PixelBox& box)
        : depths(kTilePixels, 1), words(kTilePixels, 0) {
        const auto isWithin = [&](int x, int y) { return x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1; };
        visitPixels(clusters, view, true, [&](int x, int y, float depth, std::uint32_t id) {
            if (!isWithin(x, y)) return;
            float& min = depths[inTile(x - box.x0, y - box.y0)];
            min = std::min(min, depth);
            std::uint64_t& word = words[inTile(x - box.x0, y - box.y0)];
            word = std::max(word, visibilityWord(depth, id));
            ++fragments;
        });
    }

    std::vector<float> depths;
    std::vector<std::uint64_t> words;
    std::uint64_t fragments = 0;
};

void compareTile(const SnappedScene& scene, const View& view, const PixelBox& box) {
    const PlainTile plain(scene.kept, view, box);
    std::vector<float> depths(kTilePixels, 1);
    std::vector<std::uint64_t> words(kTilePixels, 0);
    const TileWork work{box, scene.all, scene.indices};
    EXPECT_EQ(drawDepthTile(work, depths.data()), plain.fragments);
    drawVisibilityTile(work, words.data());
    for (int y = 0; y < box.height(); ++y)
        for (int x = 0; x < box.width(); ++x) {
            ASSERT_EQ(
                std::bit_cast<std::uint32_t>(depths[inTile(x, y)]),
                std::bit_cast<std::uint32_t>(plain.depths[inTile(x, y)]));
            ASSERT_EQ(words[inTile(x, y)], plain.words[inTile(x, y)]) << x << ' ' << y;
        }
}

TEST(TileKernel, DrawsOneTileAsPlainlyOnEveryInstructionSet) {
    tests::onEachTarget([](const char* name) {
        SCOPED_TRACE(name);
        const View view = flatView(kTileViewport);
        const Projection pass = projection(view, true);
        for (const double spacing : {0.4, 1.5, 3.0, 7.0, 30.0, 90.0}) {
            const Scene scene = sheet(24, 24, spacing, 7);
            const SnappedScene snapped(scene.clusters(), pass);
            for (const PixelBox& box :
                 {PixelBox{0, 0, 256, 256},
                  PixelBox{37, 11, 38, 12},
                  PixelBox{5, 3, 60, 40},
                  PixelBox{250, 40, 400, 100}})
                compareTile(snapped, view, box);
        }
    });
}

/// Triangles of about `size` pixels around (x, y), at any depth near `depth`.
void addHeap(Scene& scene, Random& random, double x, double y, double size) {
    const double depth = random.uniform(0.1, 0.9);
    const auto cells = [](double at) {
        return static_cast<std::uint32_t>(static_cast<std::int64_t>(kSceneCenter) + std::llround(at));
    };
    std::vector<std::array<std::uint32_t, 3>> positions;
    std::vector<Triangle> triangles;
    for (std::uint8_t t = 0; t < 40; ++t) {
        const double left = x + random.uniform(-2, 2) * size;
        const double low = y + random.uniform(-2, 2) * size;
        for (int corner = 0; corner < 3; ++corner)
            positions.push_back(
                {cells((left + random.uniform(-1, 1) * size) * kFlatPixel),
                 cells((low + random.uniform(-1, 1) * size) * kFlatPixel),
                 cells((depth + random.uniform(-0.05, 0.05)) * 0x1p20)});
        const auto first = static_cast<std::uint8_t>(3 * t);
        triangles.push_back({first, static_cast<std::uint8_t>(first + 1), static_cast<std::uint8_t>(first + 2)});
    }
    scene.add(std::move(positions), std::move(triangles));
}

/// Whether a pixel of `tile` between the extremes of a triangle holds nothing nearer than it could be.
bool mayBeSeen(
    const SnappedCluster& cluster,
    const Triangle& triangle,
    const PixelBox& tile,
    const std::vector<std::uint64_t>& words) {
    std::array<int, 2> min = {1 << 30, 1 << 30};
    std::array<int, 2> max = {-(1 << 30), -(1 << 30)};
    float nearest = 0;
    for (const std::uint8_t index : triangle) {
        int x = cluster.vertices.x[index];
        int y = cluster.isCompact ? 0 : cluster.vertices.y[index];
        if (cluster.isCompact) {
            const auto both = static_cast<std::uint32_t>(x);
            x = static_cast<int>(both & 0xFFFFU) + (cluster.box.x0 - 1) * kSubpixels;
            y = static_cast<int>(both >> 16U) + (cluster.box.y0 - 1) * kSubpixels;
        }
        min = {std::min(min[0], x), std::min(min[1], y)};
        max = {std::max(max[0], x), std::max(max[1], y)};
        nearest = std::max(nearest, std::min(cluster.vertices.z[index], 1.0F));
    }
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) {
            const bool isBetween = x * kSubpixels >= min[0] && x * kSubpixels <= max[0] && y * kSubpixels >= min[1] &&
                                   y * kSubpixels <= max[1];
            if (isBetween && visibleDepth(words[inTile(x - tile.x0, y - tile.y0)]) <= nearest) return true;
        }
    return false;
}

/// Draws a scene's clusters one after another; how many triangles over the tile were passed by, none of which may be
/// seen.
int passedBy(const SnappedScene& snapped, const PixelBox& tile, std::vector<std::uint64_t>& words) {
    const std::vector<std::uint64_t> nothing(kTilePixels, 0);
    FarthestDepths<WordDepths> farthest(words.data(), tile.width(), tile.height());
    int count = 0;
    for (const std::uint32_t& index : snapped.indices) {
        const std::vector<std::uint64_t> before = words;
        const SnappedCluster& cluster = snapped.all[index];
        const TriangleBits setUp = drawVisibilityTile({tile, snapped.all, {&index, 1}}, words.data(), &farthest);
        for (std::size_t t = 0; t < cluster.triangles.size(); ++t) {
            if ((setUp[t / 64] >> (t % 64) & 1U) != 0) continue;
            EXPECT_FALSE(mayBeSeen(cluster, cluster.triangles[t], tile, before)) << index << ' ' << t;
            count += mayBeSeen(cluster, cluster.triangles[t], tile, nothing) ? 1 : 0;
        }
        farthest.noteDrawn({0, 0, tile.width(), tile.height()});
    }
    return count;
}

TEST(TileKernel, PassesByTrianglesThatAreHiddenAndNoOthers) {
    const View view = flatView(kTileViewport);
    const PixelBox tile{20, 10, 120, 110};
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        Random random(seed);
        Scene scene;
        for (int i = 0; i < 60; ++i)
            addHeap(scene, random, random.uniform(0, 300), random.uniform(0, 250), std::exp2(random.uniform(0, 7)));
        const SnappedScene snapped(scene.clusters(), projection(view, true));
        const PlainTile plain(snapped.kept, view, tile);
        std::optional<int> passed;
        tests::onEachTarget([&](const char* name) {
            SCOPED_TRACE(name);
            std::vector<std::uint64_t> words(kTilePixels, 0);
            const int count = passedBy(snapped, tile, words);
            EXPECT_EQ(count, passed.value_or(count));
            passed = count;
            for (int y = 0; y < tile.height(); ++y)
                EXPECT_TRUE(
                    std::equal(&words[inTile(0, y)], &words[inTile(tile.width(), y)], &plain.words[inTile(0, y)]));
        });
        EXPECT_GT(passed.value_or(0), 30);
    }
}

TEST(TileKernel, TakesNamesFromAListWhereThereIsOne) {
    const View view = flatView(kTileViewport);
    const Scene scene = sheet(8, 8, 12, 3);
    SnappedScene snapped(scene.clusters(), projection(view, true));
    ASSERT_EQ(snapped.all.size(), 1U);
    std::vector<std::uint32_t> names(snapped.all[0].triangles.size());
    for (std::uint32_t i = 0; i < names.size(); ++i)
        names[i] = 1000 - 3 * i;
    const PixelBox box{0, 0, 120, 120};
    std::vector<std::uint64_t> plain(kTilePixels, 0);
    std::vector<std::uint64_t> named(kTilePixels, 0);
    drawVisibilityTile({box, snapped.all, snapped.indices}, plain.data());
    snapped.all[0].triangleIds = names.data();
    drawVisibilityTile({box, snapped.all, snapped.indices}, named.data());
    int drawn = 0;
    for (int y = 0; y < box.height(); ++y)
        for (int x = 0; x < box.width(); ++x) {
            const std::uint64_t word = plain[inTile(x, y)];
            ASSERT_EQ(word == 0, named[inTile(x, y)] == 0);
            if (word == 0) continue;
            EXPECT_EQ(visibleTriangle(named[inTile(x, y)]), names[visibleTriangle(word)]);
            EXPECT_EQ(visibleDepth(named[inTile(x, y)]), visibleDepth(word));
            ++drawn;
        }
    EXPECT_GT(drawn, 3000);
}

TEST(TileKernel, LeavesOutClustersThatItIsNotGiven) {
    const View view = flatView(kTileViewport);
    const Scene scene = sheet(24, 24, 4, 3);
    const SnappedScene snapped(scene.clusters(), projection(view, true));
    std::vector<float> depths(kTilePixels, 1);
    EXPECT_EQ(drawDepthTile({{0, 0, 64, 64}, snapped.all, {}}, depths.data()), 0U);
    const std::array<std::uint32_t, 1> one{0};
    const std::uint64_t first = drawDepthTile({{0, 0, 64, 64}, snapped.all, one}, depths.data());
    EXPECT_GT(first, 0U);
    EXPECT_LT(first, drawDepthTile({{0, 0, 64, 64}, snapped.all, snapped.indices}, depths.data()));
}

TEST(Prefetch, OfAnyRangeDoesNothingThatIsSeen) {
    const std::array<std::byte, 1000> bytes{};
    for (const std::size_t count : {0U, 1U, 63U, 64U, 65U, 1000U})
        prefetch(bytes.data(), count);
    EXPECT_EQ(bytes[999], std::byte{0});
}

} // namespace
} // namespace gnomon::raster
