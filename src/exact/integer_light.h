// The direction of the light as exact shadows take it: integers, so that every decision can be made without rounding.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

namespace gnomon::exact {

/// The bits of a light's components, and of the weights of a point within its triangle.
constexpr int kLightBits = 24;
constexpr int kWeightBits = 24;

/// Towards the light, along the axes of the grid; each component is above -2^24 and below 2^24, the largest is at least
/// 2^24 - 1 in size.
struct IntegerLight {
    glm::i64vec3 direction{0, (std::int64_t{1} << kLightBits) - 1, 0};
};

/// The nearest such light to `towardsLight`, which has a finite length above 0: less than 2^-24 radians off.
IntegerLight roundedLight(const glm::dvec3& towardsLight);

/// The shear along the light that makes it upright: (u, v) says which ray towards the light a point lies on, h how far
/// along it. Its entries are at most 1 in size; determinants keep their size, and change their sign with `sign`.
struct LightShear {
    int along = 1; // the axis of the light's largest component: 0, 1 or 2
    int first = 2; // the other two, cyclically behind it
    int second = 0;
    double firstRatio = 0; // u = p[first] - firstRatio * p[along]
    double secondRatio = 0;
    double sign = 1;      // h = sign * p[along]: larger nearer to the light
    double component = 0; // the size of the largest component: h grows by it over one `direction`
};

LightShear shearAlong(const IntegerLight& light);

} // namespace gnomon::exact
