// Conversion of colours with any range of numbers to 8 bits per channel.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cstdint>

namespace gnomon::read {

/// White: the colour of a vertex or face without a colour in an input where other vertices or faces have colours.
constexpr std::uint32_t kNoColor = 0xFFFFFFFF;

/// Returns the value of full intensity for channels that are real numbers with the maximum `max`: 1 if `max` is at most
/// 1, else 255.
inline double fullOfReals(double max) {
    return max > 1 ? 255 : 1;
}

/// Returns the value of full intensity for integers with the maximum `max`, whose type has the maximum `largest`: 255
/// if `max` or `largest` is at most 255. Otherwise returns the smaller of 65535 and `largest` if `max` is at most
/// 65535, else `largest`.
inline double fullOfIntegers(double max, double largest) {
    return max <= 255 || largest <= 255 ? 255 : max <= 65535 ? std::min(largest, 65535.0) : largest;
}

/// Returns the channel `value` as a byte, where `full` becomes 255. Clamps to 0 and 255; NaN becomes 0.
inline std::uint8_t channelByte(double value, double full) {
    value *= 255 / full;
    return static_cast<std::uint8_t>(value > 0 ? std::min(value, 255.0) + 0.5 : 0.0);
}

/// Returns `rgba` as RGBA8 with red in the lowest byte, where `full` becomes 255.
inline std::uint32_t packedChannels(const glm::dvec4& rgba, double full) {
    std::uint32_t color = 0;
    for (int i = 0; i < 4; ++i)
        color |= std::uint32_t{channelByte(rgba[i], full)} << (8 * static_cast<unsigned>(i));
    return color;
}

} // namespace gnomon::read
