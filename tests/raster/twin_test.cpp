// The vector kernels against plain code: identical bytes on every instruction set, with one thread and with two.
#include "raster/raster.h"
#include "tests/raster/plain_raster.h"
#include "tests/raster/scenes.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include <hwy/highway.h>

namespace gnomon::raster {
namespace {

constexpr int kWidth = 333; // no multiple of anything
constexpr int kHeight = 290;
constexpr PixelBox kTwinViewport = {7, 5, 330, 281};

/// Runs `draw` on every instruction set that this machine has, with one thread and with two.
template <class Draw>
void onEveryTarget(const Draw& draw) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        for (const int threads : {1, 2}) {
            SCOPED_TRACE(std::string(hwy::TargetName(target)) + ", threads " + std::to_string(threads));
            tbb::task_arena(threads).execute(draw);
        }
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

/// By their bits: 0 and -0 differ.
std::size_t differences(const std::vector<float>& a, const std::vector<float>& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += std::bit_cast<std::uint32_t>(a[i]) == std::bit_cast<std::uint32_t>(b[i]) ? 0U : 1U;
    return count;
}

std::size_t differences(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += a[i] == b[i] ? 0U : 1U;
    return count;
}

/// Both kinds of pass over the same clusters; what is outside the viewport must stay.
void expectSameAsPlain(const std::vector<Cluster>& clusters, const View& view) {
    const std::size_t pixels = std::size_t{kWidth} * kHeight;
    std::vector<float> plainDepths(pixels, -7);
    std::vector<std::uint64_t> plainWords(pixels, 7);
    const std::uint64_t fragments = plainDepth(clusters, view, {plainDepths.data(), kWidth, kHeight});
    plainVisibility(clusters, view, {plainWords.data(), kWidth, kHeight});
    EXPECT_TRUE(std::any_of(plainDepths.begin(), plainDepths.end(), [](float d) { return d >= 0 && d < 1; }));

    std::vector<Cluster> shuffled(clusters.rbegin(), clusters.rend());
    Rasterizer rasterizer;
    onEveryTarget([&] {
        std::vector<float> depths(pixels, -7);
        std::vector<std::uint64_t> words(pixels, 7);
        EXPECT_EQ(rasterizer.drawDepth(shuffled, view, {depths.data(), kWidth, kHeight}), fragments);
        rasterizer.drawVisibility(clusters, view, {words.data(), kWidth, kHeight});
        EXPECT_EQ(differences(depths, plainDepths), 0U);
        EXPECT_EQ(differences(words, plainWords), 0U);
    });
}

TEST(Twin, SheetsOfEverySizeOfTriangle) {
    for (const double spacing : {0.3, 1.4, 4.0, 11.0, 40.0, 150.0}) {
        SCOPED_TRACE(spacing);
        const int quads = static_cast<int>(std::min(120.0, std::ceil(kWidth / spacing) + 1));
        const Scene scene = sheet(quads, quads, spacing, 3);
        expectSameAsPlain(scene.clusters(), flatView(kTwinViewport));
    }
}

TEST(Twin, TrianglesOfAllSizesThroughEachOther) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        SCOPED_TRACE(seed);
        const Scene scene = soup(600, seed);
        expectSameAsPlain(scene.clusters(), flatView(kTwinViewport));
    }
}

TEST(Twin, PerspectiveThroughNearAndBehindTheEye) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        SCOPED_TRACE(seed);
        const Scene scene = soup(300, seed);
        expectSameAsPlain(scene.clusters(), insideView(kTwinViewport, seed));
    }
}

TEST(Twin, StridesNamesAndEmptyClusters) {
    const Scene scene = sheet(20, 20, 9, 5);
    std::vector<Cluster> clusters = scene.clusters();
    std::vector<std::vector<std::uint32_t>> wide; // a vertex of five words, as pages have it
    for (Cluster& cluster : clusters) {
        std::vector<std::uint32_t>& words = wide.emplace_back();
        for (std::uint32_t i = 0; i < cluster.vertexCount; ++i) {
            words.insert(
                words.end(), cluster.positions + std::size_t{3} * i, cluster.positions + std::size_t{3} * i + 3);
            words.insert(words.end(), {0xFFFFFFFFU, 0xFFFFFFFFU});
        }
        cluster.positions = words.data();
        cluster.positionStride = 20;
        cluster.firstTriangleId = 0xFFFFFFFFU - cluster.firstTriangleId - 256;
    }
    clusters.push_back({});
    expectSameAsPlain(clusters, flatView(kTwinViewport));
}

TEST(Twin, NothingToDrawClearsTheViewportAlone) {
    std::vector<float> depths(std::size_t{kWidth} * kHeight, -7);
    Rasterizer().drawDepth({}, flatView(kTwinViewport), {depths.data(), kWidth, kHeight});
    const auto cleared = static_cast<int>(std::count(depths.begin(), depths.end(), 1.0F));
    EXPECT_EQ(cleared, kTwinViewport.width() * kTwinViewport.height());
}

TEST(Twin, TheLeastNameWinsATie) {
    Scene scene;
    for (int copy = 0; copy < 3; ++copy)
        scene.add(
            {{kSceneCenter, kSceneCenter, kSceneCenter + 1000},
             {kSceneCenter + 40 * kFlatPixel, kSceneCenter, kSceneCenter + 5000},
             {kSceneCenter, kSceneCenter + 40 * kFlatPixel, kSceneCenter + 9000}},
            {{0, 1, 2}});
    std::vector<Cluster> clusters = scene.clusters();
    std::rotate(clusters.begin(), clusters.begin() + 1, clusters.end());
    std::vector<std::uint64_t> words(std::size_t{64} * 64);
    Rasterizer().drawVisibility(clusters, flatView({0, 0, 64, 64}), {words.data(), 64, 64});
    const auto drawn = std::count_if(words.begin(), words.end(), [](std::uint64_t w) { return w != 0; });
    const auto first =
        std::count_if(words.begin(), words.end(), [](std::uint64_t w) { return w != 0 && visibleTriangle(w) == 0; });
    EXPECT_GT(drawn, 500);
    EXPECT_EQ(first, drawn);
}

} // namespace
} // namespace gnomon::raster
