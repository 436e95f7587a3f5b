// The direction of the light as a vector of integers. It is rounded only once, so that plan, shadow maps, rays, exact
// shadows and shading use identical bits. Exact shadows need no other rounding.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cstdint>

namespace gnomon {

/// The number of bits of each component of the light direction, without its sign.
constexpr int kLightBits = 24;

/// The direction towards the light in world axes, which are also the axes of the vertex grid. Each absolute component
/// is less than 2^24, and the largest one is at least 2^24 - 1.
struct IntegerLight {
    glm::i64vec3 direction{0, (std::int64_t{1} << kLightBits) - 1, 0};

    /// Returns the light direction as a unit vector.
    glm::dvec3 unit() const { return glm::normalize(glm::dvec3(direction)); }

    friend bool operator==(const IntegerLight&, const IntegerLight&) = default;
};

/// Returns the integer light direction that is nearest to `towardsLight`, whose length must be finite and greater than
/// 0. The angular error is less than 2^-24 radians. The direction of an IntegerLight is rounded to itself.
IntegerLight roundedLight(const glm::dvec3& towardsLight);

} // namespace gnomon
