#include "exact/light_shear.h"

#include <cmath>

namespace gnomon::exact {

LightShear shearAlong(const IntegerLight& light) {
    const glm::dvec3 direction(light.direction);
    LightShear shear;
    shear.along = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(direction[i]) > std::abs(direction[shear.along])) shear.along = i;
    shear.first = (shear.along + 1) % 3;
    shear.second = (shear.along + 2) % 3;
    shear.firstRatio = direction[shear.first] / direction[shear.along];
    shear.secondRatio = direction[shear.second] / direction[shear.along];
    shear.sign = direction[shear.along] > 0 ? 1 : -1;
    shear.component = std::abs(direction[shear.along]);
    return shear;
}

} // namespace gnomon::exact
