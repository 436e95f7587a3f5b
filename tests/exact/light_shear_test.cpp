// The shear along the rounded light.
#include "exact/light_shear.h"
#include "tests/exact/random.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::exact {
namespace {

glm::dvec3 someDirection(RandomWholes& random) {
    glm::dvec3 direction(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
    // Now and then nearly or quite along an axis or a diagonal.
    if (random.whole(0, 3) == 0) direction[static_cast<int>(random.whole(0, 2))] *= 1e-9;
    if (random.whole(0, 3) == 0) direction[static_cast<int>(random.whole(0, 2))] = 0;
    if (random.whole(0, 3) == 0) direction.y = direction.x;
    return direction * std::exp2(random.real(-300, 300));
}

TEST(LightShear, MakesTheLightUpright) {
    RandomWholes random(2);
    for (int i = 0; i < 5000; ++i) {
        const glm::dvec3 direction = someDirection(random);
        if (direction == glm::dvec3(0)) continue;
        const IntegerLight light = roundedLight(direction);
        const LightShear shear = shearAlong(light);
        const glm::dvec3 l(light.direction);
        EXPECT_LE(std::abs(shear.firstRatio), 1);
        EXPECT_LE(std::abs(shear.secondRatio), 1);
        EXPECT_NEAR(l[shear.first] - shear.firstRatio * l[shear.along], 0, 1e-8);
        EXPECT_NEAR(l[shear.second] - shear.secondRatio * l[shear.along], 0, 1e-8);
        EXPECT_EQ(shear.sign * l[shear.along], shear.component);
        EXPECT_GT(shear.component, 0);
    }
}

TEST(LightShear, KeepsDeterminantsUpToItsSign) {
    RandomWholes random(3);
    for (int i = 0; i < 5000; ++i) {
        const glm::dvec3 direction = someDirection(random);
        if (direction == glm::dvec3(0)) continue;
        const LightShear shear = shearAlong(roundedLight(direction));
        std::array<glm::dvec3, 3> edges{};
        std::array<glm::dvec3, 3> sheared{};
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 p(random.point(-1000, 1000));
            edges[k] = p;
            sheared[k] = {
                p[shear.first] - shear.firstRatio * p[shear.along],
                p[shear.second] - shear.secondRatio * p[shear.along],
                shear.sign * p[shear.along]};
        }
        const double before = glm::dot(glm::cross(edges[0], edges[1]), edges[2]);
        const double after = glm::dot(glm::cross(sheared[0], sheared[1]), sheared[2]);
        EXPECT_NEAR(after, shear.sign * before, 1e-3);
    }
}

} // namespace
} // namespace gnomon::exact
