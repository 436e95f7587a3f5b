// The direction of the light in integers: rounded once, it is the same to the bit in plan, maps, rays, exact shadows
// and shading, and what exact shadows decide needs no further rounding.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cstdint>

namespace gnomon {

/// The bits of a light's components.
constexpr int kLightBits = 24;

/// Towards the light, along the axes of the world, which are the grid's; each component is above -2^24 and below 2^24,
/// the largest is at least 2^24 - 1 in size.
struct IntegerLight {
    glm::i64vec3 direction{0, (std::int64_t{1} << kLightBits) - 1, 0};

    /// The same as a vector of length 1.
    glm::dvec3 unit() const { return glm::normalize(glm::dvec3(direction)); }

    friend bool operator==(const IntegerLight&, const IntegerLight&) = default;
};

/// The nearest such light to `towardsLight`, which has a finite length above 0: less than 2^-24 radians off. Such a
/// light's own direction gives it back.
IntegerLight roundedLight(const glm::dvec3& towardsLight);

} // namespace gnomon
