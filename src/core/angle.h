// Converts angles between degrees, which users read and write, and radians, which all computations use.
#pragma once

#include <numbers>

namespace gnomon {

inline constexpr double kPi = std::numbers::pi;

/// Converts an angle from degrees to radians.
constexpr double radiansFromDegrees(double degrees) {
    return degrees * (kPi / 180);
}

/// Converts an angle from radians to degrees.
constexpr double degreesFromRadians(double radians) {
    return radians * 180 / kPi;
}

} // namespace gnomon
