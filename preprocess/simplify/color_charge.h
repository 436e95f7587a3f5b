// Converts a wrong colour to an error in units of length, so that it can be compared with geometric errors.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace gnomon::simplify {

/// The max difference of a colour channel (share of full scale) that is invisible in a shaded image.
constexpr double kUnseenDifference = 0.03;

/// The difference of a colour channel (share of full scale) at which the error is equal to the width of the wrong
/// region.
constexpr double kWrongPixel = 0.3;

/// The min difference of a colour channel (share of full scale) between parts of different colours. Smaller differences
/// are noise of one surface, and vertices with such differences may replace each other.
constexpr double kOtherPart = 0.1;

/// Returns the error of a region of width `length` whose colour is wrong by `difference`. The difference is that of a
/// channel, from 0 to 1. The error has the unit of `length`.
inline double colorCharge(double length, double difference) {
    return length * std::max(difference - kUnseenDifference, 0.0) / kWrongPixel;
}

/// Returns the max difference of a channel between two RGBA8 colours, from 0 to 1. Alpha is ignored.
inline double colorDifference(std::uint32_t a, std::uint32_t b) {
    int largest = 0;
    for (const std::uint32_t shift : {0U, 8U, 16U}) {
        const int apart = static_cast<int>(a >> shift & 0xFFU) - static_cast<int>(b >> shift & 0xFFU);
        largest = std::max(largest, std::abs(apart));
    }
    return largest / 255.0;
}

} // namespace gnomon::simplify
