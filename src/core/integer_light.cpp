#include "core/integer_light.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

IntegerLight roundedLight(const glm::dvec3& towardsLight) {
    constexpr double kLargest = (1 << kLightBits) - 1;
    const double size = std::max({std::abs(towardsLight.x), std::abs(towardsLight.y), std::abs(towardsLight.z)});
    IntegerLight light;
    for (int i = 0; i < 3; ++i)
        light.direction[i] = std::llround(towardsLight[i] / size * kLargest);
    return light;
}

} // namespace gnomon
