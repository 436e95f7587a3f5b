// How a wrong colour counts as an error in lengths.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace gnomon::simplify {

/// The difference of a channel, of full scale, that nobody sees in a shaded picture.
constexpr double kUnseenDifference = 0.03;

/// The difference of a channel, of full scale, that counts as an error of the wrong region's own width.
constexpr double kWrongPixel = 0.3;

/// The difference of a channel, of full scale, from which two vertices at one position belong to parts of different
/// colours. Less than that is noise of one surface, whose vertices replace each other.
constexpr double kOtherPart = 0.1;

/// Returns the charge of a region of width `length` whose colour is wrong by `difference` (of a channel, 0 to 1).
inline double colorCharge(double length, double difference) {
    return length * std::max(difference - kUnseenDifference, 0.0) / kWrongPixel;
}

/// Returns the largest difference of a channel of two colours (RGBA8, without alpha), 0 to 1.
inline double colorDifference(std::uint32_t a, std::uint32_t b) {
    int largest = 0;
    for (const std::uint32_t shift : {0U, 8U, 16U}) {
        const int apart = static_cast<int>(a >> shift & 0xFFU) - static_cast<int>(b >> shift & 0xFFU);
        largest = std::max(largest, std::abs(apart));
    }
    return largest / 255.0;
}

} // namespace gnomon::simplify
