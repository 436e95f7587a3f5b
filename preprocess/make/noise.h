// Noise, sine and cosine functions that use only additions and multiplications. Each machine therefore computes the
// same test model.
#pragma once

#include "core/random.h"

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>

namespace gnomon::make {

/// Returns the sine of an angle, which is given in full turns. The error is below 1e-9. The result is identical on all
/// CPUs, unlike the result of the C library.
inline double sinTurns(double turns) {
    double x = turns - std::floor(turns + 0.5); // in [-1/2, 1/2)
    if (x > 0.25) x = 0.5 - x;
    if (x < -0.25) x = -0.5 - x;
    const double a = x * 6.283185307179586;
    const double b = a * a;
    return a * (1 - b / 6 * (1 - b / 20 * (1 - b / 42 * (1 - b / 72 * (1 - b / 110 * (1 - b / 156 * (1 - b / 210)))))));
}

/// Returns the cosine of an angle, which is given in full turns. The accuracy is that of sinTurns.
inline double cosTurns(double turns) {
    return sinTurns(turns + 0.25);
}

/// Returns gradient noise (Perlin 2002) at a point with coordinates in [0, 2^22). The lattice spacing is 1. The mean
/// over space is zero, and the standard deviation is about kNoiseDeviation. The function is twice continuously
/// differentiable.
inline float gradientNoise(float x, float y, float z, std::uint32_t seed) {
    const auto ix = static_cast<std::int32_t>(x);
    const auto iy = static_cast<std::int32_t>(y);
    const auto iz = static_cast<std::int32_t>(z);
    const float fx = x - static_cast<float>(ix);
    const float fy = y - static_cast<float>(iy);
    const float fz = z - static_cast<float>(iz);
    const std::uint32_t hx = static_cast<std::uint32_t>(ix) * 0x8DA6B343U + seed;
    const std::uint32_t hy = static_cast<std::uint32_t>(iy) * 0xD8163841U;
    const std::uint32_t hz = static_cast<std::uint32_t>(iz) * 0xCB1AB31FU;
    const auto corner = [&](std::uint32_t dx, std::uint32_t dy, std::uint32_t dz) {
        std::uint32_t h = (hx + dx * 0x8DA6B343U) ^ (hy + dy * 0xD8163841U) ^ (hz + dz * 0xCB1AB31FU);
        h = (h ^ (h >> 15U)) * 0x2C1B3C6DU;
        h ^= h >> 13U;
        const auto component = [](std::uint32_t bits) {
            return static_cast<float>(static_cast<std::int32_t>(bits & 255U)) - 127.5F;
        };
        return component(h) * (fx - static_cast<float>(dx)) + component(h >> 8U) * (fy - static_cast<float>(dy)) +
               component(h >> 16U) * (fz - static_cast<float>(dz));
    };
    const auto fade = [](float t) { return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F); };
    const auto mix = [](float a, float b, float t) { return a + t * (b - a); };
    const float u = fade(fx);
    const float v = fade(fy);
    const float w = fade(fz);
    const float bottom = mix(mix(corner(0, 0, 0), corner(1, 0, 0), u), mix(corner(0, 1, 0), corner(1, 1, 0), u), v);
    const float top = mix(mix(corner(0, 0, 1), corner(1, 0, 1), u), mix(corner(0, 1, 1), corner(1, 1, 1), u), v);
    return mix(bottom, top, w) * (1.0F / 127.5F);
}

/// The standard deviation over space of the values of gradientNoise.
inline constexpr double kNoiseDeviation = 0.1915;

} // namespace gnomon::make
