// Conversion between degrees, for input and output, and radians, for all computations.
#pragma once

#include <numbers>

namespace gnomon {

inline constexpr double kPi = std::numbers::pi;

/// Returns an angle in radians from `degrees`.
constexpr double radiansFromDegrees(double degrees) {
    return degrees * (kPi / 180);
}

/// Returns an angle in degrees from `radians`.
constexpr double degreesFromRadians(double radians) {
    return radians * 180 / kPi;
}

} // namespace gnomon
