// Converts doubles to floats with directed rounding (down or up).
#pragma once

#include <cmath>
#include <limits>

namespace gnomon::exact {

/// Returns the largest float that is not above `value`.
inline float roundedDown(double value) {
    const auto nearest = static_cast<float>(value);
    return nearest <= value ? nearest : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

/// Returns the smallest float that is not below `value`.
inline float roundedUp(double value) {
    return -roundedDown(-value);
}

} // namespace gnomon::exact
