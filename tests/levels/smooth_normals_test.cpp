// Smooth normals: the mean of the faces by area, and none where a face is more than 40 degrees from it.
#include "hierarchy/octahedral.h"
#include "preprocess/levels/smooth_normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gnomon::levels {
namespace {

using hierarchy::GridPoint;

glm::dvec3 toVector(const GridPoint& p) {
    return {p.x, p.y, p.z};
}

/// Two rectangles on the y axis that each fall off by `degrees`, the right one `width` times as wide.
struct Roof {
    Roof(double degrees, double width) {
        const double angle = degrees * std::numbers::pi / 180;
        const auto add = [this](double x, double y, double z) {
            positions.push_back(
                {static_cast<std::uint32_t>(std::lround(x)),
                 static_cast<std::uint32_t>(std::lround(y)),
                 static_cast<std::uint32_t>(std::lround(z))});
        };
        const double run = 1e6 * std::cos(angle);
        const double fall = 1e6 * std::sin(angle);
        for (const double y : {0.0, 1e6}) {
            add(2e6, y, 5e6);
            add(2e6 - run, y, 5e6 - fall);
            add(2e6 + run * width, y, 5e6 - fall * width);
        }
    }

    std::vector<std::uint32_t> normals() const { return smoothNormals(positions, triangles); }

    std::vector<GridPoint> positions;
    // Each side is cut along both diagonals of its own half, so that all corners of the ridge have both sides alike.
    std::vector<simplify::Triangle> triangles{{1, 0, 3}, {1, 3, 4}, {0, 2, 5}, {0, 5, 3}};
};

glm::dvec3 faceNormal(const Roof& roof, const simplify::Triangle& t) {
    const glm::dvec3 a = toVector(roof.positions[t[0]]);
    return glm::cross(toVector(roof.positions[t[1]]) - a, toVector(roof.positions[t[2]]) - a);
}

TEST(SmoothNormals, AreTheMeanOfTheFacesByArea) {
    for (const double width : {1.0, 2.0, 3.5}) {
        const Roof roof(20, width);
        const std::vector<std::uint32_t> normals = roof.normals();
        ASSERT_EQ(normals.size(), roof.positions.size());
        for (std::uint32_t p = 0; p < normals.size(); ++p) {
            glm::dvec3 sum(0);
            for (const simplify::Triangle& t : roof.triangles)
                if (t[0] == p || t[1] == p || t[2] == p) sum += faceNormal(roof, t);
            EXPECT_EQ(normals[p], hierarchy::packNormal(sum)) << p;
        }
    }
}

/// The largest angle, in degrees, of a face at `p` from the mean of all there. At corner 0 the left side has one
/// triangle and the right side two, at corner 3 it is the other way round: the mean is nearer to the side of two.
double angleFromMean(const Roof& roof, std::uint32_t p) {
    glm::dvec3 sum(0);
    for (const simplify::Triangle& t : roof.triangles)
        if (t[0] == p || t[1] == p || t[2] == p) sum += faceNormal(roof, t);
    double max = 0;
    for (const simplify::Triangle& t : roof.triangles)
        if (t[0] == p || t[1] == p || t[2] == p)
            max = std::max(max, std::acos(glm::dot(glm::normalize(faceNormal(roof, t)), glm::normalize(sum))));
    return max * 180 / std::numbers::pi;
}

TEST(SmoothNormals, EndWhereAFaceIsMoreThan40DegreesFromTheMean) {
    int smooth = 0;
    int none = 0;
    for (double degrees = 20; degrees < 60; degrees += 0.7) {
        const Roof roof(degrees, 1);
        const std::vector<std::uint32_t> normals = roof.normals();
        for (const std::uint32_t p : {0U, 3U}) {
            const double angle = angleFromMean(roof, p);
            if (std::abs(angle - 40) < 0.1) continue;
            ASSERT_EQ(normals[p] == hierarchy::kNoNormal, angle > 40) << angle;
            ++(angle > 40 ? none : smooth);
        }
        for (const std::uint32_t p : {1U, 2U, 4U, 5U}) // one side alone is flat, however steep
            ASSERT_NE(normals[p], hierarchy::kNoNormal);
    }
    EXPECT_GT(smooth, 10);
    EXPECT_GT(none, 10);
}

} // namespace
} // namespace gnomon::levels
