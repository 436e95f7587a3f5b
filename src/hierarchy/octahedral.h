// Unit normals as two snorm16 on the octahedron: what Vertex::normal holds.
#pragma once

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>

namespace gnomon::hierarchy {

/// The unit vector that a packed normal stands for; not for kNoNormal. Cigolle et al., "A Survey of Efficient
/// Representations for Independent Unit Vectors", 2014.
inline glm::vec3 unpackNormal(std::uint32_t packed) {
    const auto component = [](std::uint32_t bits) {
        return std::max(static_cast<float>(static_cast<std::int16_t>(bits & 0xFFFFU)) / 32767.0F, -1.0F);
    };
    const float x = component(packed);
    const float y = component(packed >> 16U);
    const float z = 1.0F - std::abs(x) - std::abs(y);
    const float fold = std::max(-z, 0.0F);
    return glm::normalize(glm::vec3(x < 0 ? x + fold : x - fold, y < 0 ? y + fold : y - fold, z));
}

} // namespace gnomon::hierarchy
