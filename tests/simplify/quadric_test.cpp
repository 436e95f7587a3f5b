// Quadrics against the planes that they are made of, taken one by one; and rounding up.
#include "core/random.h"
#include "preprocess/simplify/patch.h"
#include "preprocess/simplify/quadric.h"

#include <gtest/gtest.h>

#include <vector>

namespace gnomon::simplify {
namespace {

struct Plane {
    glm::dvec3 normal;
    glm::dvec3 point;
    double weight;
};

glm::dvec3 randomVector(Random& random) {
    const double x = random.uniform(-5, 5);
    const double y = random.uniform(-5, 5);
    return {x, y, random.uniform(-5, 5)};
}

TEST(Quadric, IsTheWeightedMeanOfSquaredDistancesFromItsPlanes) {
    Random random(1);
    for (int run = 0; run < 300; ++run) {
        Quadric first;
        Quadric second;
        std::vector<Plane> planes(1 + random.below(8));
        for (Plane& plane : planes) {
            plane = {glm::normalize(randomVector(random)), randomVector(random), random.uniform(0.1, 3)};
            (random.below(2) == 0 ? first : second).addPlane(plane.normal, plane.point, plane.weight);
        }
        first.add(second);
        const glm::dvec3 p = randomVector(random);
        double sum = 0;
        double weight = 0;
        for (const Plane& plane : planes) {
            const double distance = glm::dot(plane.normal, p - plane.point);
            sum += plane.weight * distance * distance;
            weight += plane.weight;
        }
        ASSERT_NEAR(first.weight, weight, 1e-12);
        ASSERT_NEAR(first.meanSquare(p), sum / weight, 1e-9);
    }
}

TEST(Quadric, IsZeroOnItsPlaneNeverBelowAndWithoutPlanes) {
    Random random(2);
    EXPECT_EQ(Quadric{}.meanSquare(glm::dvec3(1, 2, 3)), 0);
    for (int run = 0; run < 300; ++run) {
        const glm::dvec3 normal = glm::normalize(randomVector(random));
        const glm::dvec3 point = randomVector(random) * 1e6;
        Quadric quadric;
        quadric.addPlane(normal, point, 2);
        const glm::dvec3 along = glm::cross(normal, randomVector(random));
        EXPECT_GE(quadric.meanSquare(point + along), 0);   // rounding must not make it negative
        EXPECT_LT(quadric.meanSquare(point + along), 0.5); // of coordinates squared of up to 7e13
    }
}

TEST(RoundedUp, IsTheLeastFloatThatIsNotBelow) {
    Random random(3);
    for (int run = 0; run < 2000; ++run) {
        const double value = random.unit() * std::ldexp(1.0, static_cast<int>(random.below(60)) - 30);
        const float up = roundedUp(value);
        EXPECT_GE(double{up}, value);
        EXPECT_LT(double{std::nextafter(up, -1.0F)}, value);
        EXPECT_EQ(roundedUp(double{up}), up);
    }
}

} // namespace
} // namespace gnomon::simplify
