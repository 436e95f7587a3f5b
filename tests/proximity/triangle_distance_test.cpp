// The distance of a point from a prepared triangle, against what the other way to compute it says, and against the part
// of the triangle that is named as the nearest.
#include "core/random.h"
#include "preprocess/proximity/triangle_distance.h"

#include <gtest/gtest.h>

namespace gnomon::proximity {
namespace {

constexpr double kRounding = 1e-9; // of squares of up to 1e4

/// The squared distance of `p` from all of the line, plane or point that `feature` of `t` lies in.
double squareOf(TriangleFeature feature, const std::array<glm::dvec3, 3>& t, const glm::dvec3& p) {
    const auto number = static_cast<std::size_t>(feature);
    if (number >= 4) return squaredLength(p - t[number - 4]);
    if (number >= 1) {
        const glm::dvec3& from = t[number - 1];
        const glm::dvec3 along = t[number % 3] - from;
        return squaredLength(glm::cross(p - from, along)) / squaredLength(along);
    }
    const glm::dvec3 normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
    return squaredLength(normal * glm::dot(normal, p - t[0]));
}

/// On a lattice, so that points lie on edges, corners and planes, and triangles have no area, often.
glm::dvec3 latticePoint(Random& random) {
    const double x = std::floor(random.uniform(0, 5));
    const double y = std::floor(random.uniform(0, 5));
    return {x, y, std::floor(random.uniform(0, 5))};
}

TEST(PreparedTriangle, IsAsFarAsTheOtherWayAndAsTheFeatureThatItNames) {
    Random random(23);
    std::array<int, 7> features{};
    for (int run = 0; run < 20'000; ++run) {
        const std::array<glm::dvec3, 3> t = {latticePoint(random), latticePoint(random), latticePoint(random)};
        const glm::dvec3 p = latticePoint(random) + (run % 2 == 0 ? glm::dvec3(0) : glm::dvec3(0.3, -0.2, 0.1));
        const TriangleDistance found = PreparedTriangle(t[0], t[1], t[2]).distanceTo(p);
        const double other = squaredDistance(p, t[0], t[1], t[2]);
        const bool hasArea = squaredLength(glm::cross(t[1] - t[0], t[2] - t[0])) > 0;
        ASSERT_LE(found.square, other + kRounding) << run;
        ASSERT_NEAR(found.square, hasArea ? other : found.square, kRounding) << run;
        ASSERT_NEAR(found.square, squareOf(found.feature, t, p), kRounding) << run;
        ++features[static_cast<std::size_t>(found.feature)];
    }
    for (const int count : features)
        EXPECT_GT(count, 500);
}

} // namespace
} // namespace gnomon::proximity
