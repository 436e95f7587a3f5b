#include "render/overlay/color_map.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace gnomon::render {

namespace {

constexpr std::size_t kMapColors = 10;
using MapColors = std::array<std::uint32_t, kMapColors>; // colours as 0xRRGGBB, evenly spaced over the colour map

constexpr MapColors kViridis = {
    0x440154, 0x482878, 0x3e4a89, 0x31688e, 0x26828e, 0x1f9e89, 0x35b779, 0x6dcd59, 0xb4de2c, 0xfde725};
constexpr MapColors kCividis = {
    0x00204d, 0x00336f, 0x39486b, 0x575c6d, 0x707173, 0x8a8779, 0xa69d75, 0xc4b56c, 0xe4cf5b, 0xffea46};

glm::vec3 fromBytes(std::uint32_t color) {
    return glm::vec3(glm::uvec3(color >> 16U, color >> 8U & 0xFFU, color & 0xFFU)) / 255.0F;
}

glm::vec3 between(const MapColors& colors, float part) {
    const float place = part * (kMapColors - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(place), kMapColors - 2);
    return glm::mix(fromBytes(colors[below]), fromBytes(colors[below + 1]), place - static_cast<float>(below));
}

} // namespace

glm::vec3 mapColor(plan::ColorMap map, float part) {
    const float held = part > 0 ? std::min(part, 1.0F) : 0.0F;
    switch (map) {
    case plan::ColorMap::Viridis:
        return between(kViridis, held);
    case plan::ColorMap::Cividis:
        return between(kCividis, held);
    case plan::ColorMap::Grey:
        break;
    }
    return glm::vec3(glm::mix(0.15F, 0.95F, held));
}

} // namespace gnomon::render
