// Shadows known by hand, distances against brute force, and a picture shifted by a known number of pixels.
#include "core/random.h"
#include "raytrace/ground_truth.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::raytrace {
namespace {

/// A page of one cluster with the given triangles, grid step 1.
hierarchy::Page pageOf(const std::vector<std::array<hierarchy::GridPoint, 3>>& triangles) {
    hierarchy::Page page;
    hierarchy::Cluster cluster;
    for (const auto& corners : triangles) {
        hierarchy::Triangle triangle{};
        for (std::size_t i = 0; i < 3; ++i) {
            triangle[i] = static_cast<std::uint8_t>(page.vertices.size());
            page.vertices.push_back({corners[i]});
        }
        page.triangles.push_back(triangle);
    }
    cluster.vertexCount = static_cast<std::uint32_t>(page.vertices.size());
    cluster.triangleCount = static_cast<std::uint32_t>(page.triangles.size());
    page.clusters.push_back(cluster);
    return page;
}

/// A ground of 1000 x 1000 at y = 100 and a roof over x < 500 at y = 200.
hierarchy::Page groundAndRoof() {
    return pageOf(
        {{{{0, 100, 0}, {1000, 100, 0}, {1000, 100, 1000}}},
         {{{0, 100, 0}, {1000, 100, 1000}, {0, 100, 1000}}},
         {{{0, 200, 0}, {500, 200, 0}, {500, 200, 1000}}},
         {{{0, 200, 0}, {500, 200, 1000}, {0, 200, 1000}}}});
}

TEST(GroundTruth, KnowsARoofsShadow) {
    const hierarchy::Page page = groundAndRoof();
    const ClusterSpan span{&page, 0, 1};
    const glm::dvec3 eye(500, 150, 500);
    const Scene scene({&span, 1}, hierarchy::Grid{}, eye);
    Random random(81);
    std::vector<SurfacePoint> points;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 p(random.uniform(1, 999), 100, random.uniform(1, 999));
        points.push_back({glm::vec3(p - eye), {0, 1, 0}});
    }
    points.push_back({});                                              // nothing there
    const glm::vec3 towardsLight = glm::normalize(glm::vec3(1, 1, 0)); // the roof's edge falls on x = 400
    const std::vector<Light> light = litByRays(scene, points, {towardsLight});
    for (std::size_t i = 0; i < 2000; ++i) {
        const float x = points[i].position.x + 500;
        if (std::abs(x - 400) < 0.01F) continue;
        EXPECT_EQ(light[i], x < 400 ? Light::Dark : Light::Lit) << x;
    }
    EXPECT_EQ(light.back(), Light::Nothing);
    for (const Light turned : litByRays(scene, std::span(points).first(10), {-towardsLight}))
        EXPECT_EQ(turned, Light::Turned);
}

TEST(GroundTruth, DistancesAreThoseOfBruteForce) {
    Random random(82);
    for (int trial = 0; trial < 100; ++trial) {
        const std::size_t width = 1 + random.below(30);
        const std::size_t height = 1 + random.below(30);
        std::vector<std::uint8_t> marked(width * height);
        const double density = random.below(5) == 0 ? 0 : random.unit() * 0.1;
        for (std::uint8_t& mark : marked)
            mark = random.unit() < density ? 1 : 0;
        const std::vector<float> found = distanceTransform(marked, width);
        for (std::size_t i = 0; i < marked.size(); ++i) {
            double best = std::hypot(static_cast<double>(width), static_cast<double>(height));
            for (std::size_t j = 0; j < marked.size(); ++j) {
                const std::size_t rowI = i / width;
                const std::size_t rowJ = j / width;
                const double dx = static_cast<double>(i % width) - static_cast<double>(j % width);
                const double dy = static_cast<double>(rowI) - static_cast<double>(rowJ);
                if (marked[j] != 0) best = std::min(best, std::hypot(dx, dy));
            }
            EXPECT_NEAR(static_cast<double>(found[i]), best, 1e-5);
        }
    }
}

/// A value for each pixel of a picture, by its column and its row.
template <class ValueAt>
auto filled(std::size_t width, std::size_t height, const ValueAt& valueAt) {
    std::vector<decltype(valueAt(0, 0))> pixels;
    for (std::size_t i = 0; i < width * height; ++i)
        pixels.push_back(valueAt(i % width, i / width));
    return pixels;
}

TEST(GroundTruth, MeasuresAShiftedShadow) {
    constexpr std::size_t kWidth = 100;
    constexpr std::size_t kHeight = 60;
    const auto reference = filled(kWidth, kHeight, [](std::size_t x, std::size_t y) {
        return y < 10 ? Light::Nothing : x < 50 ? Light::Dark : Light::Lit;
    });
    const auto litFrom = [](std::size_t edge) {
        return filled(kWidth, kHeight, [edge](std::size_t x, std::size_t) { return std::uint8_t{x >= edge}; });
    };
    const std::vector<std::uint8_t> same = litFrom(50);
    const std::vector<std::uint8_t> shifted = litFrom(57);
    const ShadowComparison right = compareShadows(reference, same, kWidth);
    EXPECT_EQ(right.wrongPixels, 0U);
    EXPECT_EQ(right.litSidePixels, 5000U);
    EXPECT_EQ(right.edgeP99Pixels, 0);
    const ShadowComparison wrong = compareShadows(reference, shifted, kWidth);
    EXPECT_EQ(wrong.wrongPixels, 7U * 50);
    EXPECT_DOUBLE_EQ(wrong.wrongFraction, 0.07);
    EXPECT_EQ(wrong.edgeMedianPixels, 6) << "an edge is two pixels wide: 49 and 50 against 56 and 57";
    EXPECT_EQ(wrong.edgeWorstPixels, 7);
    EXPECT_EQ(wrong.worstWrongPixels, 6);
    const std::vector<std::uint8_t> noShadow(reference.size(), 1);
    EXPECT_GT(compareShadows(reference, noShadow, kWidth).edgeP99Pixels, 100);
}

// A shadow's edge that is 5 pixels off, and beside it a bar of one pixel that half of the picture misses.
TEST(GroundTruth, CountsEdgesOfWhatIsTooFineApart) {
    constexpr std::size_t kWidth = 100;
    constexpr std::size_t kHeight = 50;
    const auto reference = filled(
        kWidth, kHeight, [](std::size_t x, std::size_t) { return x < 50 || x == 70 ? Light::Dark : Light::Lit; });
    const auto bar = filled(kWidth, kHeight, [](std::size_t x, std::size_t) { return std::uint8_t{x == 70}; });
    const auto isLit = filled(
        kWidth, kHeight, [](std::size_t x, std::size_t y) { return std::uint8_t{x >= 55 && (x != 70 || y < 25)}; });
    const ShadowComparison all = compareShadows(reference, isLit, kWidth);
    EXPECT_EQ(all.wrongPixels, 5U * kHeight + 25);
    EXPECT_EQ(all.edgePixelsApart, 0U);
    EXPECT_GT(all.edgeP99Pixels, 10) << "to the next edge of another shadow";
    const ShadowComparison found = compareShadows(reference, isLit, kWidth, bar);
    EXPECT_EQ(found.wrongPixels, 5U * kHeight);
    EXPECT_EQ(found.edgePixelsApart, 3U * kHeight) << "the bar and its neighbours";
    EXPECT_EQ(found.edgePixels + found.edgePixelsApart, all.edgePixels);
    EXPECT_EQ(found.edgeP99Pixels, 5);
    EXPECT_EQ(found.edgeWorstPixels, 5) << "what is drawn of the bar is where it is";
}

} // namespace
} // namespace gnomon::raytrace
