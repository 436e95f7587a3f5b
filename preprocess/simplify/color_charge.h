// Converts the error of a wrong colour to a length, so that it can be compared with geometric errors.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace gnomon::simplify {

/// The max difference of a colour channel that is invisible in a shaded image. 1 is the full scale of the channel.
constexpr double kUnseenDifference = 0.03;

/// The difference of a colour channel at which the error is equal to the width of the wrong region. 1 is the full scale
/// of the channel.
constexpr double kWrongPixel = 0.3;

/// The min difference of a colour channel between surfaces of different colours. 1 is the full scale of the channel. A
/// smaller difference is noise of one surface, so its vertices may replace each other.
constexpr double kOtherPart = 0.1;

/// Returns the error of a region of width `length` whose colour is wrong. `difference` is the difference of a colour
/// channel, from 0 to 1. The error has the unit of `length`.
inline double colorCharge(double length, double difference) {
    return length * std::max(difference - kUnseenDifference, 0.0) / kWrongPixel;
}

/// Returns the max difference over the red, green and blue channels of two RGBA8 colours, from 0 to 1.
inline double colorDifference(std::uint32_t a, std::uint32_t b) {
    int largest = 0;
    for (const std::uint32_t shift : {0U, 8U, 16U}) {
        const int apart = static_cast<int>(a >> shift & 0xFFU) - static_cast<int>(b >> shift & 0xFFU);
        largest = std::max(largest, std::abs(apart));
    }
    return largest / 255.0;
}

} // namespace gnomon::simplify
