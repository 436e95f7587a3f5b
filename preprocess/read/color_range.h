// Colours of vertices and faces whose channels are numbers of any range.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cstdint>

namespace gnomon::read {

/// White: of a vertex or a face without a colour where others have one.
constexpr std::uint32_t kNoColor = 0xFFFFFFFF;

/// Returns the value of a full channel for channels that are real numbers of which `max` is the maximum: 1 if no number
/// exceeds 1, else 255.
inline double fullOfReals(double max) {
    return max > 1 ? 255 : 1;
}

/// Returns the same for integers of a type whose maximum is `largest`: 255, or 65535 or `largest` if one exceeds that.
inline double fullOfIntegers(double max, double largest) {
    return max <= 255 || largest <= 255 ? 255 : max <= 65535 ? std::min(largest, 65535.0) : largest;
}

/// Returns the byte of a channel that is full at `full`; a value that is no number is 0.
inline std::uint8_t channelByte(double value, double full) {
    value *= 255 / full;
    return static_cast<std::uint8_t>(value > 0 ? std::min(value, 255.0) + 0.5 : 0.0);
}

/// Returns RGBA8, red in the lowest byte, of channels that are full at `full`.
inline std::uint32_t packedChannels(const glm::dvec4& rgba, double full) {
    std::uint32_t color = 0;
    for (int i = 0; i < 4; ++i)
        color |= std::uint32_t{channelByte(rgba[i], full)} << (8 * static_cast<unsigned>(i));
    return color;
}

} // namespace gnomon::read
