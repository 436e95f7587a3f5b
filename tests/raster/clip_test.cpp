// What is left of a cut triangle, against points of the triangle in homogeneous space.
#include "raster/clip.h"
#include "tests/raster/scenes.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gnomon::raster {
namespace {

constexpr PixelBox kClipViewport = {0, 0, 256, 128};

ClipPosition randomClip(Random& random) {
    const auto value = [&](double scale) {
        return static_cast<float>(random.uniform(-1, 1) * scale * std::exp2(random.uniform(0, 4)));
    };
    return {value(1), value(1), value(0.5), value(0.5)};
}

ClipPosition mixed(const std::array<ClipPosition, 3>& t, double u, double v) {
    const double w = 1 - u - v;
    const auto mix = [&](float ClipPosition::*field) {
        return static_cast<float>(w * t[0].*field + u * t[1].*field + v * t[2].*field);
    };
    return {mix(&ClipPosition::x), mix(&ClipPosition::y), mix(&ClipPosition::z), mix(&ClipPosition::w)};
}

/// Twice the area of a polygon, counter-clockwise positive, in subpixels.
double doubleAreaOf(const ClippedPolygon& polygon) {
    double area = 0;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const SnappedVertex& a = polygon.corners[i];
        const SnappedVertex& b = polygon.corners[(i + 1) % polygon.count];
        area += static_cast<double>(a.x) * b.y - static_cast<double>(b.x) * a.y;
    }
    return area;
}

/// Whether (x, y) lies inside a convex polygon of either winding or within `slack` subpixels of it.
bool holds(const ClippedPolygon& polygon, double x, double y, double slack) {
    const double turn = doubleAreaOf(polygon) < 0 ? -1 : 1;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const SnappedVertex& a = polygon.corners[i];
        const SnappedVertex& b = polygon.corners[(i + 1) % polygon.count];
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        const double side = double(b.x - a.x) * (y - a.y) - double(b.y - a.y) * (x - a.x);
        if (turn * side < -slack * length) return false;
    }
    return true;
}

TEST(Clip, WhatIsInsideStaysAndNothingElseComes) {
    Random random(1);
    int cut = 0;
    int checked = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const bool cutsDepth = trial % 2 == 0;
        const Projection pass = projection(flatView(kClipViewport), cutsDepth);
        const std::array<ClipPosition, 3> triangle{randomClip(random), randomClip(random), randomClip(random)};
        const ClippedPolygon polygon = clipTriangle(pass, triangle);
        ASSERT_LE(polygon.count, 9U);
        cut += polygon.count > 3 ? 1 : 0;
        for (std::size_t i = 0; i < polygon.count; ++i) {
            EXPECT_LE(std::abs(polygon.corners[i].x), 2 * kGuardPixels * kSubpixels);
            EXPECT_LE(std::abs(polygon.corners[i].y), 2 * kGuardPixels * kSubpixels);
            if (cutsDepth) {
                EXPECT_GE(polygon.corners[i].z, -1e-5F);
                EXPECT_LE(polygon.corners[i].z, 1 + 1e-5F);
            }
        }
        for (int sample = 0; sample < 20; ++sample) {
            const double u = random.unit();
            const double v = random.unit() * (1 - u);
            const ClipPosition p = mixed(triangle, u, v);
            if (p.w < 0.05F || outsideBits(pass, p) != 0) continue;
            ASSERT_GE(polygon.count, 3U) << trial;
            const SnappedVertex seen = snapped(pass, p);
            EXPECT_TRUE(holds(polygon, seen.x, seen.y, 4)) << trial << ": " << seen.x << ' ' << seen.y;
            ++checked;
        }
    }
    EXPECT_GT(cut, 300);
    EXPECT_GT(checked, 3000);
}

TEST(Clip, WhatNeedsNoCutKeepsItsBits) {
    Random random(2);
    int whole = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Projection pass = projection(flatView(kClipViewport), true);
        std::array<ClipPosition, 3> triangle;
        for (ClipPosition& p : triangle) {
            const auto w = static_cast<float>(random.uniform(0.1, 4));
            p = {
                static_cast<float>(random.uniform(-2, 2)) * w,
                static_cast<float>(random.uniform(-2, 2)) * w,
                static_cast<float>(random.unit()) * w,
                w};
        }
        const ClippedPolygon polygon = clipTriangle(pass, triangle);
        ASSERT_EQ(polygon.count, 3U) << "off screen, but inside the guard and between the planes";
        for (std::size_t k = 0; k < 3; ++k) {
            const SnappedVertex expected = snapped(pass, triangle[k]);
            EXPECT_EQ(polygon.corners[k].x, expected.x);
            EXPECT_EQ(polygon.corners[k].y, expected.y);
            EXPECT_EQ(polygon.corners[k].z, expected.z);
            EXPECT_EQ(polygon.corners[k].restX, expected.restX);
            EXPECT_EQ(polygon.corners[k].restY, expected.restY);
        }
        ++whole;
    }
    EXPECT_EQ(whole, 2000);
}

// Neighbours are cut each by itself, in either direction of their edge: their new corners must be the same.
TEST(Clip, BothSidesOfAnEdgeAreCutAtTheSamePoint) {
    Random random(3);
    int shared = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Projection pass = projection(flatView(kClipViewport), true);
        ClipPosition inside{0, 0, 0.5F, 1};
        inside.x = static_cast<float>(random.uniform(-1, 1));
        const ClipPosition outside = randomClip(random);
        if ((outsideBits(pass, outside) & 48U) == 0) continue;
        const ClipPosition left{-0.5F, 0.5F, 0.4F, 1};
        const ClipPosition right{0.5F, -0.5F, 0.6F, 1};
        const ClippedPolygon a = clipTriangle(pass, {inside, outside, left});
        const ClippedPolygon b = clipTriangle(pass, {outside, inside, right});
        int same = 0;
        for (std::size_t i = 0; i < a.count; ++i)
            for (std::size_t j = 0; j < b.count; ++j)
                same += a.corners[i].x == b.corners[j].x && a.corners[i].y == b.corners[j].y &&
                                a.corners[i].z == b.corners[j].z && a.corners[i].restX == b.corners[j].restX
                            ? 1
                            : 0;
        EXPECT_GE(same, 2) << "the corner inside and the cut";
        ++shared;
    }
    EXPECT_GT(shared, 500);
}

TEST(Clip, BehindTheEyeAndEdgeOnNothingIsLeft) {
    const Projection pass = projection(flatView(kClipViewport), true);
    const ClipPosition behind{0, 0, 0, -1};
    EXPECT_LT(clipTriangle(pass, {behind, {1, 0, 0, -1}, {0, 1, 0, -2}}).count, 3U);
    const ClipPosition eye{0, 0, 0, 0};
    EXPECT_EQ(clipTriangle(pass, {eye, {0.5F, 0, 0.5F, 1}, {0, 0.5F, 0.5F, 1}}).count, 0U) << "seen edge on";
    EXPECT_LT(clipTriangle(pass, {ClipPosition{0, 0, 2, 1}, {1, 0, 2, 1}, {0, 1, 2, 1}}).count, 3U) << "too near";
    EXPECT_LT(clipTriangle(pass, {ClipPosition{0, 0, -1, 1}, {1, 0, -1, 1}, {0, 1, -1, 1}}).count, 3U) << "too far";
    const Projection plain = projection(flatView(kClipViewport), false);
    EXPECT_EQ(clipTriangle(plain, {ClipPosition{0, 0, 2, 1}, {1, 0, 2, 1}, {0, 1, 2, 1}}).count, 3U)
        << "depth is not cut";
    const float huge = std::numeric_limits<float>::infinity();
    EXPECT_EQ(clipTriangle(pass, {ClipPosition{huge, 0, 0.5F, 1}, {1, 0, 0.5F, 1}, {0, 1, 0.5F, 1}}).count, 0U)
        << "what overflowed is not drawn";
}

} // namespace
} // namespace gnomon::raster
