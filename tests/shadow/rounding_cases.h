// Set-ups of shadow maps under one rounding and under another: the same decisions, but for those that a bound of what
// rounding can do calls undecided, and promises that agree in 24 bits.
#pragma once

#include "random_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <iostream>
#include <limits>

namespace gnomon::shadow {

inline constexpr double kPromiseBits = 0x1p-24;

/// The plain orientation jumps where the sine of light and view is 1e-12 (lightFrame).
inline bool isAtTheJumpOfOrientation(const glm::dvec3& towardsLight) {
    return std::abs(sinLightAngle(towardsLight) * 1e12 - 1) < 1e-3;
}

/// How far `p` is from the next plane or depth where another partition begins, over its distance from the eye.
inline double marginOf(const PartitionSelector& selector, const glm::dvec3& p) {
    double margin = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i + 1 < selector.splits.size(); ++i)
        margin = std::min(margin, std::abs(p.z - selector.splits[i]) / p.z);
    const double nearDepth = selector.splits[sliceOf(selector.splits, p.z)];
    for (const FaceSelector& face : selector.faces) {
        for (const glm::dvec3& plane : {face.first, face.second})
            if (plane != glm::dvec3(0))
                margin = std::min(margin, std::abs(glm::dot(plane, p)) / (glm::length(plane) * glm::length(p)));
        const double beyond = glm::dot(face.edge, p) - face.edgeOffset * nearDepth;
        if (selector.ownNear) margin = std::min(margin, std::abs(beyond) / (glm::length(face.edge) * glm::length(p)));
    }
    return margin;
}

/// Below this a point's partition is undecided: planes and depths are off by at most some 1e-13.
inline constexpr double kUndecided = 1e-12;

struct RoundingCounts {
    bool mayChangeLayout = false; // how maps share the texture
    std::uint64_t layouts = 0;    // set-ups where it did
    double worstLayout = 0;       // relative difference of their promises
    std::uint64_t views = 0;
    std::uint64_t points = 0;
    std::uint64_t undecided = 0;   // of the points
    std::uint64_t jumps = 0;       // views whose plain orientation is undecided
    std::uint64_t moved = 0;       // points whose partition another mode changed, all undecided
    std::uint64_t ties = 0;        // set-ups in which a search chose a warp otherwise
    double worstTie = 0;           // relative difference of their promises
    double worstMargin = 0;        // of those
    double worstPromise = 0;       // relative difference
    std::uint64_t conditioned = 0; // maps whose promise is off by more, as much as its condition number lets it be
    double worstConditioned = 0;   // relative difference of their promises
};

/// One view with points of it, and what it comes to.
struct RoundedCase {
    explicit RoundedCase(Random& random) : view(randomView(random)), options(randomOptions(random, view.frustum)) {
        for (int i = 0; i < 8; ++i)
            points.push_back(randomPointIn(random, view.frustum));
    }

    ShadowMapSetup setup() const { return shadowMapSetup(view, options, std::nullopt); }

    std::vector<std::size_t> owners(const PartitionSelector& selector) const {
        std::vector<std::size_t> result;
        for (const glm::dvec3& p : points)
            result.push_back(ownerOf(selector, p));
        return result;
    }

    ShadowView view;
    ShadowOptions options;
    std::vector<glm::dvec3> points;
};

/// `owners`: of the points, by another rounding.
inline void expectSameOwners(
    const RoundedCase& given,
    const ShadowMapSetup& usual,
    const std::vector<std::size_t>& owners,
    RoundingCounts& counts) {
    for (std::size_t i = 0; i < given.points.size(); ++i) {
        const glm::dvec3& p = given.points[i];
        const std::size_t owner = owners[i];
        if (owner == ownerOf(usual.selector, p)) continue;
        const double margin = marginOf(usual.selector, p);
        ++counts.moved;
        counts.worstMargin = std::max(counts.worstMargin, margin);
        EXPECT_LT(margin, kUndecided) << "another partition, and nothing says so";
        // Whichever it is, its map covers the point.
        const std::size_t map = usual.mapOfPartition[owner];
        const MapPoint at = mapPoint(usual.maps[map].warped, p);
        EXPECT_GT(std::min(at.s, at.t), -1e-6);
        EXPECT_LT(std::max(at.s, at.t), 1 + 1e-6);
    }
}

/// Whether a search for the least S ended elsewhere in any map: two places are as good but for its tolerance, and
/// rounding chooses between them.
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

/// Of maps that share the texture in another way: each asks for the same texels, and promises what the texels that it
/// has come to. A texel more or less makes the search for a packing end at another one, as good but for some percent.
inline void expectSameDemands(const ShadowMapSetup& usual, const ShadowMapSetup& other, RoundingCounts& counts) {
    for (std::size_t i = 0; i < usual.maps.size(); ++i) {
        const ShadowMap& a = usual.maps[i];
        const ShadowMap& b = other.maps[i];
        EXPECT_NEAR(other.demands[i].s / usual.demands[i].s, 1, kPromiseBits);
        EXPECT_NEAR(other.demands[i].t / usual.demands[i].t, 1, kPromiseBits);
        if (a.stable) continue; // snapping takes a part of a texel
        const double forTexelS = b.promised.x * b.texels().s / (a.promised.x * a.texels().s);
        const double forTexelT = b.promised.z * b.texels().t / (a.promised.z * a.texels().t);
        EXPECT_NEAR(forTexelS, 1, kPromiseBits) << "map " << i;
        EXPECT_NEAR(forTexelT, 1, kPromiseBits) << "map " << i;
    }
    const double promise = std::abs(other.worst().worst() / usual.worst().worst() - 1);
    counts.worstLayout = std::max(counts.worstLayout, promise);
    EXPECT_LE(promise, 0.1) << "one packing is not as good as the other";
}

/// By how much a promise may grow for a relative error of the vertices: w is 1 at the least z, next to which a vertex
/// that is as far away as the far plane may lie, off by an error of its own size.
inline double conditionOfPromise(const ShadowMap& map) {
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
        const double promise = std::abs(other.worst().sheared / usual.worst().sheared - 1);
        counts.worstTie = std::max(counts.worstTie, promise);
        EXPECT_LE(promise, 1e-3) << "what a texel more or less comes to";
        return;
    }
    bool isSameLayout = other.textureWidth == usual.textureWidth && other.textureHeight == usual.textureHeight;
    for (std::size_t i = 0; i < usual.maps.size(); ++i) // a texel more in one map may move another in the texture
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
        const double promise = std::max(
            {std::abs(b.promised.x / a.promised.x - 1),
             std::abs(b.promised.z / a.promised.z - 1),
             std::abs(b.promised.sheared / a.promised.sheared - 1)});
        if (promise > kPromiseBits) {
            ++counts.conditioned;
            counts.worstConditioned = std::max(counts.worstConditioned, promise);
        } else {
            counts.worstPromise = std::max(counts.worstPromise, promise);
        }
        EXPECT_LE(promise, std::max(kPromiseBits, conditionOfPromise(a) * 0x1p-52)) << "map " << i;
    }
}

/// Draws a case, and holds what it comes to under each of `roundings` to what it comes to usually.
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

/// What the environment asks for, for runs by hand.
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
              << counts.worstPromise << "; " << counts.conditioned << " maps within their condition, off by at most "
              << counts.worstConditioned << "\n";
}

} // namespace gnomon::shadow
