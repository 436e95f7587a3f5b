// The light, rounded once.
#include "core/integer_light.h"
#include "core/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

TEST(RoundedLight, IsLessThanTwoToTheMinus24Off) {
    Random random(1);
    for (int i = 0; i < 20000; ++i) {
        glm::dvec3 unit(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        // Now and then along an axis, in a plane of two, nearly so, or along a diagonal.
        for (int axis = 0; axis < 3; ++axis)
            if (random.below(4) == 0) unit[axis] *= random.below(2) == 0 ? 0 : 1e-9;
        if (random.below(4) == 0) unit.z = unit.x;
        if (unit == glm::dvec3(0)) continue;
        unit = glm::normalize(unit);
        const IntegerLight light = roundedLight(unit * std::exp2(random.uniform(-300, 300)));
        EXPECT_LT(glm::length(glm::cross(unit, light.unit())), 0x1p-24);
        EXPECT_GT(glm::dot(unit, light.unit()), 0);
        std::int64_t largest = 0;
        for (int axis = 0; axis < 3; ++axis)
            largest = std::max(largest, std::abs(light.direction[axis]));
        EXPECT_EQ(largest, (1 << kLightBits) - 1);
        EXPECT_EQ(roundedLight(-unit).direction, -roundedLight(unit).direction);
        EXPECT_EQ(roundedLight(glm::dvec3(light.direction)), light) << "rounded twice";
        EXPECT_EQ(roundedLight(light.unit()), light) << "rounded from its own direction";
    }
}

} // namespace
} // namespace gnomon
