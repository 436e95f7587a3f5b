// Converts colour channels of any numeric range to 8 bits per channel.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cstdint>

namespace gnomon::read {

/// White, the colour of vertices and faces without a colour. It is used if other parts of the input have colours.
constexpr std::uint32_t kNoColor = 0xFFFFFFFF;

/// Returns which value of a floating-point colour channel means full intensity: 1 or 255. `max` is the max channel
/// value in the file. The result is 1 if `max` is at most 1, and 255 otherwise.
inline double fullOfReals(double max) {
    return max > 1 ? 255 : 1;
}

/// Returns which value of an integer colour channel means full intensity. `max` is the max channel value in the file,
/// and `largest` is the max value of the integer type. The result is
/// - 255 if `max` or `largest` is at most 255,
/// - the smaller of 65535 and `largest` if `max` is at most 65535,
/// - `largest` otherwise.
inline double fullOfIntegers(double max, double largest) {
    return max <= 255 || largest <= 255 ? 255 : max <= 65535 ? std::min(largest, 65535.0) : largest;
}

/// Converts the colour channel `value` to a byte from 0 to 255. The value `full` becomes 255. Values outside this range
/// are clamped, and NaN becomes 0.
inline std::uint8_t channelByte(double value, double full) {
    value *= 255 / full;
    return static_cast<std::uint8_t>(value > 0 ? std::min(value, 255.0) + 0.5 : 0.0);
}

/// Converts the colour `rgba` to RGBA8 with red in the lowest byte. The channel value `full` becomes 255.
inline std::uint32_t packedChannels(const glm::dvec4& rgba, double full) {
    std::uint32_t color = 0;
    for (int i = 0; i < 4; ++i)
        color |= std::uint32_t{channelByte(rgba[i], full)} << (8 * static_cast<unsigned>(i));
    return color;
}

} // namespace gnomon::read
