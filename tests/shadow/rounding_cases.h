// Comparison of shadow-map set-ups under different rounding modes. Decisions must be equal unless a bound of the
// rounding error marks them as undecided. Aliasing bounds must agree in 24 bits.
#pragma once

#include "tests/support/random_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <iostream>
#include <limits>

namespace gnomon::shadow {

inline constexpr double kBoundBits = 0x1p-24;

/// Returns true if the light is at the jump of the plain orientation, where the sine of light and view is 1e-12
/// (lightFrame).
inline bool isAtTheJumpOfOrientation(const glm::dvec3& towardsLight) {
    return std::abs(sinLightAngle(towardsLight) * 1e12 - 1) < 1e-3;
}

/// Returns the distance of `p` from the nearest border of its partition, relative to its distance from the eye.
inline double marginOf(const PartitionSelector& selector, const glm::dvec3& p) {
    double margin = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i + 1 < selector.splits.size(); ++i)
        margin = std::min(margin, std::abs(p.z - selector.splits[i]) / p.z);
    const double nearDepth = selector.splits[sliceOf(selector.splits, p.z)];
    for (const FaceSelector& face : selector.faces) {
        for (const glm::dvec3& plane : {face.first, face.second})
            if (plane != glm::dvec3(0))
                margin = std::min(margin, std::abs(glm::dot(plane, p)) / (glm::length(plane) * glm::length(p)));
        const double edgeDistance = glm::dot(face.edge, p) - face.edgeOffset * nearDepth;
        if (selector.ownNear)
            margin = std::min(margin, std::abs(edgeDistance) / (glm::length(face.edge) * glm::length(p)));
    }
    return margin;
}

/// Margin below which the partition of a point is undecided. Planes and depths have errors of at most about 1e-13.
inline constexpr double kUndecided = 1e-12;

struct RoundingCounts {
    bool mayChangeLayout = false; // if true, the layout of maps in the texture may change
    std::uint64_t layouts = 0;    // set-ups with a changed layout
    double worstLayout = 0;       // relative difference of their bounds
    std::uint64_t views = 0;
    std::uint64_t points = 0;
    std::uint64_t undecided = 0;   // undecided points
    std::uint64_t jumps = 0;       // views whose plain orientation is undecided
    std::uint64_t moved = 0;       // points whose partition changed with the rounding mode; all are undecided
    std::uint64_t ties = 0;        // set-ups in which the search chose another warp
    double worstTie = 0;           // relative difference of their bounds
    double worstMargin = 0;        // largest margin of the moved points
    double worstBound = 0;         // relative difference
    std::uint64_t conditioned = 0; // maps whose bound differs by more, but within its condition number
    double worstConditioned = 0;   // relative difference of their bounds
};

/// A view with points, and its set-up.
struct RoundedCase {
    explicit RoundedCase(Random& random) : view(randomView(random)), options(randomOptions(random, view.frustum)) {
        for (int i = 0; i < 8; ++i)
            points.push_back(randomPointIn(random, view.frustum));
    }

    ShadowMapSetup setup() const { return shadowMapSetup(view, options, std::nullopt); }

    std::vector<std::size_t> owners(const PartitionSelector& selector) const {
        std::vector<std::size_t> result;
        for (const glm::dvec3& p : points)
            result.push_back(partitionIndex(selector, p));
        return result;
    }

    ShadowView view;
    ShadowOptions options;
    std::vector<glm::dvec3> points;
};

/// Compares the partitions of the points under another rounding mode, `owners`, with the usual ones.
inline void expectSameOwners(
    const RoundedCase& given,
    const ShadowMapSetup& usual,
    const std::vector<std::size_t>& owners,
    RoundingCounts& counts) {
    for (std::size_t i = 0; i < given.points.size(); ++i) {
        const glm::dvec3& p = given.points[i];
        const std::size_t owner = owners[i];
        if (owner == partitionIndex(usual.selector, p)) continue;
        const double margin = marginOf(usual.selector, p);
        ++counts.moved;
        counts.worstMargin = std::max(counts.worstMargin, margin);
        EXPECT_LT(margin, kUndecided) << "another partition, and nothing says so";
        // Both maps cover the point, so either is correct.
        const std::size_t map = usual.mapOfPartition[owner];
        const MapPoint at = mapPoint(usual.maps[map].warped, p);
        EXPECT_GT(std::min(at.s, at.t), -1e-6);
        EXPECT_LT(std::max(at.s, at.t), 1 + 1e-6);
    }
}

/// Returns true if the search for the min S chose another warp in any map. Two warps can be equally good within its
/// tolerance, and rounding decides.
inline bool isAnotherWarp(const ShadowMapSetup& a, const ShadowMapSetup& b) {
    constexpr double kRounding = 1e-10;
    for (std::size_t i = 0; i < a.maps.size(); ++i) {
        const WarpedMap& one = a.maps[i].warped;
        const WarpedMap& other = b.maps[i].warped;
        if (std::abs(one.kappa - other.kappa) > kRounding * one.kappa) return true;
        if (glm::length(one.frame.z - other.frame.z) > kRounding) return true;
    }
    return false;
}

/// Compares set-ups with different layouts. Each map must require the same texels, and its bound must match its number
/// of texels. One texel more or less can lead the search to another packing with a similar result.
inline void expectSameDemands(const ShadowMapSetup& usual, const ShadowMapSetup& other, RoundingCounts& counts) {
    for (std::size_t i = 0; i < usual.maps.size(); ++i) {
        const ShadowMap& a = usual.maps[i];
        const ShadowMap& b = other.maps[i];
        EXPECT_NEAR(other.demands[i].s / usual.demands[i].s, 1, kBoundBits);
        EXPECT_NEAR(other.demands[i].t / usual.demands[i].t, 1, kBoundBits);
        if (a.stable) continue; // snapping uses a part of a texel
        const double forTexelS = b.aliasingBound.x * b.texels().s / (a.aliasingBound.x * a.texels().s);
        const double forTexelT = b.aliasingBound.z * b.texels().t / (a.aliasingBound.z * a.texels().t);
        EXPECT_NEAR(forTexelS, 1, kBoundBits) << "map " << i;
        EXPECT_NEAR(forTexelT, 1, kBoundBits) << "map " << i;
    }
    const double bound = std::abs(other.worst().worst() / usual.worst().worst() - 1);
    counts.worstLayout = std::max(counts.worstLayout, bound);
    EXPECT_LE(bound, 0.1) << "one packing is not as good as the other";
}

/// Returns the condition number of a bound: the relative change of the bound per relative error of the vertices. w is 1
/// at the min z. A vertex next to it can be as distant as the far plane, with an error proportional to its own
/// distance.
inline double conditionOfBound(const ShadowMap& map) {
    double farthest = 0;
    for (const FitVertex& vertex : map.region.vertices)
        farthest = std::max(farthest, glm::length(vertex.position));
    return map.warped.kappa * farthest;
}

inline void expectSameMaps(const ShadowMapSetup& usual, const ShadowMapSetup& other, RoundingCounts& counts) {
    ASSERT_EQ(other.mapOfPartition, usual.mapOfPartition);
    ASSERT_EQ(other.maps.size(), usual.maps.size());
    if (isAnotherWarp(usual, other)) {
        ++counts.ties;
        const double bound = std::abs(other.worst().sheared / usual.worst().sheared - 1);
        counts.worstTie = std::max(counts.worstTie, bound);
        EXPECT_LE(bound, 1e-3) << "what a texel more or less comes to";
        return;
    }
    bool isSameLayout = other.textureWidth == usual.textureWidth && other.textureHeight == usual.textureHeight;
    for (std::size_t i = 0; i < usual.maps.size(); ++i) // one texel more in a map can move another map in the texture
        isSameLayout = isSameLayout && other.maps[i].rectangle == usual.maps[i].rectangle;
    if (!isSameLayout && counts.mayChangeLayout) {
        ++counts.layouts;
        expectSameDemands(usual, other, counts);
        return;
    }
    EXPECT_TRUE(isSameLayout);
    for (std::size_t i = 0; i < usual.maps.size(); ++i) {
        const ShadowMap& a = usual.maps[i];
        const ShadowMap& b = other.maps[i];
        EXPECT_EQ(b.region.face, a.region.face);
        EXPECT_EQ(b.rectangle, a.rectangle);
        EXPECT_EQ(b.warped.kappa > 0, a.warped.kappa > 0);
        EXPECT_EQ(b.warped.rows, a.warped.rows);
        const double bound = std::max(
            {std::abs(b.aliasingBound.x / a.aliasingBound.x - 1),
             std::abs(b.aliasingBound.z / a.aliasingBound.z - 1),
             std::abs(b.aliasingBound.sheared / a.aliasingBound.sheared - 1)});
        if (bound > kBoundBits) {
            ++counts.conditioned;
            counts.worstConditioned = std::max(counts.worstConditioned, bound);
        } else {
            counts.worstBound = std::max(counts.worstBound, bound);
        }
        EXPECT_LE(bound, std::max(kBoundBits, conditionOfBound(a) * 0x1p-52)) << "map " << i;
    }
}

/// Makes a case, and compares its result under each of `roundings` with the usual result.
template <class Rounding, class Seed>
inline void expectSame(Random& random, std::initializer_list<Seed> roundings, RoundingCounts& counts) {
    const RoundedCase given(random);
    ++counts.views;
    const ShadowMapSetup usual = given.setup();
    counts.points += given.points.size();
    for (const glm::dvec3& p : given.points)
        counts.undecided += marginOf(usual.selector, p) < kUndecided ? 1 : 0;
    if (isAtTheJumpOfOrientation(given.view.towardsLight)) {
        ++counts.jumps;
        return;
    }
    for (const Seed& seed : roundings) {
        SCOPED_TRACE(testing::Message() << "rounding " << seed << ", warp " << name(given.options.scheme.warp.rule));
        ShadowMapSetup other;
        std::vector<std::size_t> owners;
        {
            const Rounding rounding(seed);
            other = given.setup();
            owners = given.owners(other.selector);
        }
        ASSERT_EQ(other.selector.faces.size(), usual.selector.faces.size());
        for (std::size_t i = 0; i < usual.selector.faces.size(); ++i)
            EXPECT_EQ(other.selector.faces[i].face, usual.selector.faces[i].face);
        expectSameMaps(usual, other, counts);
        expectSameOwners(given, usual, owners, counts);
    }
}

/// Returns a number from the environment, for manual runs.
inline std::uint64_t asked(const char* name, std::uint64_t usual) {
    const char* text = std::getenv(name);
    return text != nullptr ? std::strtoull(text, nullptr, 10) : usual;
}

inline void report(const RoundingCounts& counts) {
    if (std::getenv("GNOMON_ROUNDING_VIEWS") == nullptr) return;
    std::cout << counts.views << " views, " << counts.jumps << " at the jump of the plain orientation; "
              << counts.points << " points, " << counts.undecided << " undecided, " << counts.moved
              << " times another partition, at most " << counts.worstMargin << " from its edge; " << counts.layouts
              << " set-ups whose layout changed, promises off by at most " << counts.worstLayout << ", " << counts.ties
              << " whose search ended elsewhere, promises off by at most " << counts.worstTie << ", of the others "
              << counts.worstBound << "; " << counts.conditioned << " maps within their condition, off by at most "
              << counts.worstConditioned << "\n";
}

} // namespace gnomon::shadow
