// The light's pad and the wire frames against what is obviously right.
#include "core/random.h"
#include "viewer/panel/texel_plot.h"
#include "viewer/panel/wire_frames.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::viewer {
namespace {

glm::dvec3 randomDirection(Random& random) {
    for (;;) {
        const double x = random.uniform(-1, 1);
        const double y = random.uniform(-1, 1);
        const glm::dvec3 v(x, y, random.uniform(-1, 1));
        const double length = glm::length(v);
        if (length > 0.1 && length <= 1) return v / length;
    }
}

Camera randomCamera(Random& random) {
    const glm::dvec3 eye = randomDirection(random) * random.uniform(1, 50);
    return {eye, eye + randomDirection(random), {0, 1, 0}, random.uniform(0.4, 1.6)};
}

TEST(LightDisc, IsTheInverseOfItself) {
    Random random(1);
    for (int i = 0; i < 500; ++i) {
        const LightDisc disc = lightDisc(randomCamera(random), i % 2 == 1);
        const glm::dvec3 light = randomDirection(random);
        if (glm::length(disc.point(light)) > 1) continue; // of the other hemisphere
        EXPECT_LE(glm::length(disc.direction(disc.point(light)) - light), 1e-9);
        EXPECT_EQ(light.y < 0, disc.fromBelow);
    }
}

TEST(LightDisc, HasThePoleInTheMiddleAndAheadAtTheTop) {
    const LightDisc disc = lightDisc({{0, 0, 0}, {1, -0.5, 0}, {0, 2, 0}, 1}, false);
    EXPECT_LE(glm::length(disc.direction({0, 0}) - glm::dvec3(0, 1, 0)), 1e-12);
    EXPECT_LE(glm::length(disc.direction({0, 1}) - glm::dvec3(1, 0, 0)), 1e-12);
    EXPECT_LE(glm::length(disc.direction({1, 0}) - glm::dvec3(0, 0, 1)), 1e-12); // right of looking along x
}

TEST(TexelPlot, HoldsTheStorageFactorOfEveryLightOnceItIsComplete) {
    Random random(2);
    TexelPlotInput input;
    const Camera camera = randomCamera(random);
    input.disc = lightDisc(camera, false);
    input.basis = cameraBasis(camera);
    input.frustum = {0.5, 60, camera.fovYRadians / 2, 1.3};
    input.scheme.slices = 2;
    TexelPlot plot(9);
    plot.ask(input);
    int rounds = 0;
    while (!plot.isComplete() && ++rounds < 100)
        plot.improve(5);
    EXPECT_TRUE(plot.isComplete());
    EXPECT_GT(rounds, 5);
    for (int row = 0; row < plot.side(); ++row)
        for (int column = 0; column < plot.side(); ++column) {
            const glm::dvec2 at = plot.middle(column, row);
            ASSERT_EQ(plot.at(column, row).has_value(), glm::length(at) <= 1);
            if (!plot.at(column, row)) continue;
            const glm::dvec3 light = toCamera(input.basis, input.disc.direction(at));
            EXPECT_EQ(
                *plot.at(column, row),
                shadow::storageFactor(shadow::schemeMaps(input.frustum, glm::normalize(light), input.scheme)));
        }
    plot.ask(input);
    EXPECT_TRUE(plot.isComplete());
    input.scheme.slices = 3;
    plot.ask(input);
    EXPECT_FALSE(plot.isComplete());
    plot.ask(std::nullopt); // nobody waits for an answer any more
    EXPECT_TRUE(plot.isComplete());
    EXPECT_TRUE(plot.at(4, 4).has_value());
}

/// A convex volume around the origin.
ConvexVolume randomVolume(Random& random, int planes) {
    ConvexVolume volume;
    for (int i = 0; i < planes; ++i) {
        const glm::dvec3 normal = randomDirection(random);
        volume.planes.push_back({normal, random.uniform(0.5, 3)});
    }
    return volume;
}

/// Corners by brute force: every point in which three planes meet that all others hold.
std::vector<glm::dvec3> corners(const ConvexVolume& volume) {
    std::vector<glm::dvec3> result;
    const auto& planes = volume.planes;
    for (std::size_t a = 0; a < planes.size(); ++a)
        for (std::size_t b = a + 1; b < planes.size(); ++b)
            for (std::size_t c = b + 1; c < planes.size(); ++c) {
                const glm::dmat3 rows =
                    glm::transpose(glm::dmat3(planes[a].normal, planes[b].normal, planes[c].normal));
                if (std::abs(glm::determinant(rows)) < 1e-9) continue;
                const glm::dvec3 point =
                    glm::inverse(rows) * -glm::dvec3(planes[a].offset, planes[b].offset, planes[c].offset);
                bool isInside = true;
                for (const Plane& plane : planes)
                    isInside = isInside && plane.signedDistance(point) > -1e-9;
                if (isInside) result.push_back(point);
            }
    return result;
}

TEST(WireFrames, ABoxHasTwelveEdges) {
    const Box box{{1e6, 2, 3}, {1e6 + 4, 5, 6}};
    const auto found = edges(volumeOf(box), volumeOf({box.min - 10.0, box.max + 10.0}));
    ASSERT_EQ(found.size(), 12U);
    double length = 0;
    for (const Segment& edge : found)
        length += glm::length(edge[1] - edge[0]);
    EXPECT_NEAR(length, 4 * (4 + 3 + 3), 1e-6);
}

TEST(WireFrames, EdgesRunBetweenTheCornersOfAnyConvexVolume) {
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        const ConvexVolume volume = randomVolume(random, 8);
        const ConvexVolume limit = volumeOf({glm::dvec3(-4), glm::dvec3(4)});
        ConvexVolume both = volume;
        both.planes.insert(both.planes.end(), limit.planes.begin(), limit.planes.end());
        const std::vector<glm::dvec3> ends = corners(both);
        const std::vector<Segment> found = edges(volume, limit);
        std::vector<int> uses(ends.size(), 0);
        for (const Segment& edge : found)
            for (const glm::dvec3& end : edge) {
                bool isCorner = false;
                for (std::size_t c = 0; c < ends.size(); ++c)
                    if (glm::length(ends[c] - end) < 1e-7) {
                        isCorner = true;
                        ++uses[c];
                    }
                EXPECT_TRUE(isCorner) << i;
            }
        for (const int count : uses)
            EXPECT_EQ(count, 3) << i; // planes in general position
    }
}

TEST(WireFrames, AVolumeOutsideTheLimitHasNone) {
    const ConvexVolume box = volumeOf({glm::dvec3(10), glm::dvec3(11)});
    EXPECT_TRUE(edges(box, volumeOf({glm::dvec3(0), glm::dvec3(1)})).empty());
}

TEST(WireFrames, FallOnThePictureWherePointsDo) {
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        const PictureFrame frame{randomCamera(random), 640, 480};
        const CameraBasis basis = cameraBasis(frame.camera);
        const double x = random.uniform(-2, 2);
        const double y = random.uniform(-2, 2);
        const glm::dvec3 front(x, y, random.uniform(0.5, 9));
        const glm::dvec3 other(y, x, random.uniform(-9, 9));
        const auto world = [&](const glm::dvec3& p) { return frame.camera.eye + toWorld(basis, p); };
        const std::vector<Segment> segment = {{world(front), world(other)}};
        const auto lines = onPicture(segment, frame);
        ASSERT_EQ(lines.size(), 1U);
        const double pixels = 240 / std::tan(frame.camera.fovYRadians / 2);
        const auto pixel = [&](const glm::dvec3& p) {
            return glm::dvec2(320 + pixels * p.x / p.z, 240 - pixels * p.y / p.z);
        };
        EXPECT_LE(glm::length(lines[0][0] - pixel(front)), 1e-6);
        if (other.z > 0.1) {
            EXPECT_LE(glm::length(lines[0][1] - pixel(other)), 1e-6);
        }
    }
}

TEST(WireFrames, WhatIsBehindTheEyeIsNotDrawn) {
    const PictureFrame frame{{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1}, 100, 100};
    const std::vector<Segment> behind = {{glm::dvec3(0, 0, 1), glm::dvec3(1, 1, 5)}};
    EXPECT_TRUE(onPicture(behind, frame).empty());
}

} // namespace
} // namespace gnomon::viewer
