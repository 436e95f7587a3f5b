// Packs unit normals into two 16-bit signed normalized integers (snorm16) by octahedral encoding. This is the format
// of Vertex::normal.
#pragma once

#include "hierarchy/page.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace gnomon::hierarchy {

/// The number of significant bits per component of a packed normal. The lower bits are 0 and use no space in the file.
/// Ten bits have an error of at most 0.28 degrees. The model of a statue is then a sixth smaller than with sixteen
/// bits.
constexpr unsigned kNormalBits = 10;

/// Packs a direction of any length as a normal, with each component rounded to kNormalBits. Returns kNoNormal for a
/// zero or infinite vector. The function uses only basic arithmetic, so the result is identical on all platforms.
inline std::uint32_t packNormal(const glm::dvec3& direction) {
    const double sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    if (!(sum > 0) || !std::isfinite(sum)) return kNoNormal;
    double x = direction.x / sum;
    double y = direction.y / sum;
    if (direction.z < 0) {
        const double foldedX = (1 - std::abs(y)) * (x < 0 ? -1.0 : 1.0);
        y = (1 - std::abs(x)) * (y < 0 ? -1.0 : 1.0);
        x = foldedX;
    }
    static constexpr int kStep = 1 << (16U - kNormalBits);
    static constexpr int kMaxStep = 32768 / kStep - 1;
    const auto snorm = [](double v) {
        const int steps = static_cast<int>(std::floor(v * 32767.0 / kStep + 0.5));
        return static_cast<std::uint32_t>(std::clamp(steps, -kMaxStep, kMaxStep) * kStep) & 0xFFFFU;
    };
    return snorm(x) | snorm(y) << 16U;
}

/// Unpacks an octahedral normal to a unit vector (Cigolle et al., "A Survey of Efficient Representations for
/// Independent Unit Vectors", 2014). Returns a zero vector for kNoNormal.
inline glm::dvec3 unpackNormal(std::uint32_t packed) {
    if (packed == kNoNormal) return glm::dvec3(0);
    const auto component = [](std::uint32_t bits) {
        return std::max(static_cast<double>(static_cast<std::int16_t>(bits & 0xFFFFU)) / 32767.0, -1.0);
    };
    const double x = component(packed);
    const double y = component(packed >> 16U);
    const double z = 1.0 - std::abs(x) - std::abs(y);
    const double fold = std::max(-z, 0.0);
    return glm::normalize(glm::dvec3(x < 0 ? x + fold : x - fold, y < 0 ? y + fold : y - fold, z));
}

} // namespace gnomon::hierarchy
