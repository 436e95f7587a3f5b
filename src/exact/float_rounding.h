// Doubles to floats in a direction that is known.
#pragma once

#include <cmath>
#include <limits>

namespace gnomon::exact {

/// The greatest float that is not above `value`.
inline float roundedDown(double value) {
    const auto nearest = static_cast<float>(value);
    return nearest <= value ? nearest : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

/// The least float that is not below `value`.
inline float roundedUp(double value) {
    return -roundedDown(-value);
}

} // namespace gnomon::exact
