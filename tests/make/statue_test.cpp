#include "preprocess/make/noise.h"
#include "preprocess/make/statue.h"
#include "tests/make/made_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::make {
namespace {

constexpr std::uint64_t kStatueSeed = 1;

/// Shared by all tests, since it is the slow part.
std::shared_ptr<const StatueSurface> surface() {
    static const auto made = std::make_shared<const StatueSurface>(kStatueSeed);
    return made;
}

double heightOfFinestOctave(std::uint64_t triangles, double& edge) {
    Statue statue(triangles, kStatueSeed, surface());
    const MadeMesh with = collect(statue);
    statue.dropFinestOctaves(1);
    const MadeMesh without = collect(statue);
    edge = meanEdge(with);
    std::vector<double> heights;
    for (std::size_t i = 0; i < with.vertices.size(); ++i) {
        const glm::vec3 difference = with.vertices[i] - without.vertices[i];
        const glm::vec3 outward = with.vertices[i] - glm::vec3(0, 0.4F, 0);
        heights.push_back(std::copysign(
            static_cast<double>(glm::length(difference)), static_cast<double>(glm::dot(difference, outward))));
    }
    std::sort(heights.begin(), heights.end());
    return heights[heights.size() * 98 / 100] - heights[heights.size() * 2 / 100];
}

TEST(Statue, HasTheTrianglesAskedForWithinTwoPercent) {
    for (const std::uint64_t wanted :
         {2'000ULL, 2'999ULL, 5'000ULL, 12'345ULL, 100'000ULL, 1'000'000ULL, 372'000'000ULL, 7'000'000'000ULL}) {
        const auto got = static_cast<double>(modelSize(Statue(wanted, kStatueSeed, surface())).triangles);
        EXPECT_NEAR(got, static_cast<double>(wanted), 0.02 * static_cast<double>(wanted));
    }
}

TEST(Statue, IsOneClosedSurfaceThatFacesOutwards) {
    const MadeMesh mesh = collect(Statue(30'000, kStatueSeed, surface()));
    const auto uses = edgeUses(mesh);
    for (const auto& [edge, use] : uses) {
        ASSERT_EQ(use.upwards, 1) << edge.first << " to " << edge.second;
        ASSERT_EQ(use.downwards, 1) << edge.first << " to " << edge.second;
    }
    EXPECT_EQ(mesh.vertices.size() + mesh.triangles.size(), uses.size() + 2); // Euler's formula for a sphere
    EXPECT_EQ(componentCount(mesh), 1U);
    double volume = 0;
    for (const MadeTriangle& t : mesh.triangles)
        volume += glm::dot(
                      glm::dvec3(mesh.vertices[t[0]]),
                      glm::cross(glm::dvec3(mesh.vertices[t[1]]), glm::dvec3(mesh.vertices[t[2]]))) /
                  6;
    EXPECT_GT(volume, 0.02); // cubic metres of stone
    EXPECT_LT(volume, 0.10);
}

TEST(Statue, HasNoDegenerateTriangleAndNoDoubledVertex) {
    const MadeMesh mesh = collect(Statue(200'000, kStatueSeed, surface()));
    EXPECT_EQ(welded(mesh).vertices.size(), mesh.vertices.size());
    const double edge = meanEdge(mesh);
    for (const MadeTriangle& t : mesh.triangles)
        ASSERT_GT(area(mesh, t), 1e-4 * edge * edge);
}

TEST(Statue, ItsFinestOctaveIsAtLeastThreeTenthsOfAnEdgeHigh) {
    for (const std::uint64_t triangles : {20'000ULL, 33'000ULL, 60'000ULL, 100'000ULL, 400'000ULL}) {
        double edge = 0;
        const double height = heightOfFinestOctave(triangles, edge);
        EXPECT_GE(height, 0.3 * edge) << triangles;
    }
}

TEST(Statue, CoarserStatuesHaveTheFirstOctavesOfFinerOnes) {
    const Statue coarse(50'000, kStatueSeed, surface());
    const Statue fine(372'000'000, kStatueSeed, surface());
    ASSERT_LT(coarse.octaves().size(), fine.octaves().size());
    for (std::size_t i = 0; i < coarse.octaves().size(); ++i) {
        EXPECT_EQ(coarse.octaves()[i].spacing, fine.octaves()[i].spacing);
        EXPECT_EQ(coarse.octaves()[i].deviation, fine.octaves()[i].deviation);
        EXPECT_EQ(coarse.octaves()[i].seed, fine.octaves()[i].seed);
    }
    EXPECT_LT(fine.octaves().back().spacing, 5.7 * fine.meanEdge());
}

TEST(Statue, IsTheSameShapeAtEveryNumberOfTriangles) {
    const MadeMesh coarse = collect(Statue(30'000, kStatueSeed, surface()));
    const MadeMesh fine = collect(Statue(300'000, kStatueSeed, surface()));
    Random random(5);
    double sum = 0;
    constexpr int kSamples = 150;
    for (int i = 0; i < kSamples; ++i) {
        const glm::vec3 p = coarse.vertices[random.below(coarse.vertices.size())];
        float nearest = 1e9F;
        for (const glm::vec3& q : fine.vertices)
            nearest = std::min(nearest, glm::distance(p, q));
        sum += static_cast<double>(nearest);
    }
    // The spacing of the fine vertices and the height of the octaves that only they have, no more.
    EXPECT_LT(sum / kSamples, 2 * meanEdge(fine));
}

TEST(Statue, SeedsGiveDifferentStatues) {
    const Statue one(5'000, 1, surface());
    const Statue other(5'000, 2);
    EXPECT_NE(collect(one).vertices, collect(other).vertices);
}

TEST(Noise, HasTheDeviationThatItPromises) {
    Random random(3);
    double sum = 0;
    double squares = 0;
    constexpr int kSamples = 200'000;
    for (int i = 0; i < kSamples; ++i) {
        const auto coordinate = [&] { return static_cast<float>(random.uniform(0, 500)); };
        const float x = coordinate();
        const float y = coordinate();
        const auto value = static_cast<double>(gradientNoise(x, y, coordinate(), 9));
        sum += value;
        squares += value * value;
    }
    EXPECT_NEAR(sum / kSamples, 0, 0.01);
    EXPECT_NEAR(std::sqrt(squares / kSamples), kNoiseDeviation, 0.02);
}

TEST(Noise, SineAndCosineAgreeWithTheLibrary) {
    for (int i = -1000; i <= 1000; ++i) {
        const double turns = i * 0.00317;
        EXPECT_NEAR(sinTurns(turns), std::sin(turns * 6.283185307179586), 2e-9);
        EXPECT_NEAR(cosTurns(turns), std::cos(turns * 6.283185307179586), 2e-9);
    }
}

} // namespace
} // namespace gnomon::make
