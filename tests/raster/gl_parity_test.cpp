// The rasteriser against llvmpipe: the same coverage but for a few pixels in a million, and the same depth.
#include "tests/raster/gl_depth.h"
#include "tests/raster/scenes.h"
#include "tests/support/tested_platform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::raster {
namespace {

constexpr int kGlSide = 512;
constexpr PixelBox kGlViewport = {0, 0, kGlSide, kGlSide};

struct Difference {
    int covered = 0;     // by either
    int coverage = 0;    // covered by one alone
    double maxDepth = 0; // where both cover
    int deeper = 0;      // where both cover: depths that differ by more than 1e-5
};

Difference difference(std::span<const float> ours, std::span<const float> theirs, float empty) {
    Difference result;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        const bool here = ours[i] != empty;
        const bool there = theirs[i] != empty;
        if (!here && !there) continue;
        ++result.covered;
        if (here != there) ++result.coverage;
        if (here != there) continue;
        const double depth = std::abs(double{ours[i]} - theirs[i]);
        result.maxDepth = std::max(result.maxDepth, depth);
        if (depth > 1e-5) ++result.deeper;
    }
    return result;
}

Difference depthDifference(const gl::Context& context, const Scene& scene) {
    const std::vector<Cluster> clusters = scene.clusters();
    const GlDepth gl(context, clusters, kGlSide);
    gl.draw(flatView(kGlViewport), false);
    std::vector<float> depths(std::size_t{kGlSide} * kGlSide);
    Rasterizer().drawDepth(clusters, flatView(kGlViewport), {depths.data(), kGlSide, kGlSide});
    return difference(depths, gl.depths(), 1);
}

TEST(GlParity, SheetsOfEverySizeOfTriangle) {
    const gl::Context context(gl::testedPlatform());
    for (const double spacing : {1.4, 4.0, 14.0, 100.0}) {
        // Seven tenths of the target, so that there is an outline.
        const int quads = static_cast<int>(0.7 * kGlSide / spacing);
        const Difference found = depthDifference(context, sheet(quads, quads, spacing, 5));
        EXPECT_GT(found.covered, 80000) << spacing;
        EXPECT_LE(found.coverage, 2) << spacing;
        EXPECT_LE(found.deeper, 2) << spacing << ", largest " << found.maxDepth;
    }
}

TEST(GlParity, EdgesOnPixelCentresBelongToTheSameSide) {
    const gl::Context context(gl::testedPlatform());
    Random random(3);
    Scene scene;
    for (std::uint32_t i = 0; i < 400; ++i) {
        std::vector<std::array<std::uint32_t, 3>> positions;
        const auto onCentre = [&](std::uint32_t cell) {
            const auto pixel = 16 * cell + static_cast<std::uint32_t>(random.below(12));
            return kSceneCenter + pixel * kFlatPixel + kFlatPixel / 2;
        };
        positions.reserve(3);
        for (int corner = 0; corner < 3; ++corner)
            positions.push_back({onCentre(i % 20), onCentre(i / 20), kSceneCenter + (1U << 19U)});
        scene.add(positions, {{0, 1, 2}});
    }
    const Difference found = depthDifference(context, scene);
    EXPECT_GT(found.covered, 3000);
    EXPECT_EQ(found.coverage, 0);
}

TEST(GlParity, PerspectiveThroughNear) {
    const gl::Context context(gl::testedPlatform());
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        const Scene scene = soup(120, seed);
        const std::vector<Cluster> clusters = scene.clusters();
        const View view = insideView(kGlViewport, seed);
        const GlDepth gl(context, clusters, kGlSide);
        gl.draw(view, true);
        std::vector<std::uint64_t> words(std::size_t{kGlSide} * kGlSide);
        Rasterizer().drawVisibility(clusters, view, {words.data(), kGlSide, kGlSide});
        std::vector<float> depths(words.size());
        std::transform(words.begin(), words.end(), depths.begin(), visibleDepth);
        const Difference found = difference(depths, gl.depths(), 0);
        EXPECT_LE(found.coverage, 10 + found.covered / 10000) << seed << " of " << found.covered;
        EXPECT_LE(found.deeper, 10 + found.covered / 10000) << seed << ", largest " << found.maxDepth;
    }
}

} // namespace
} // namespace gnomon::raster
