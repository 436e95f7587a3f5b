// Angles: pi, and the one way between degrees, which people type and read, and radians, which everything computes with.
#pragma once

#include <numbers>

namespace gnomon {

inline constexpr double kPi = std::numbers::pi;

/// 180 degrees are pi.
constexpr double radiansFromDegrees(double degrees) {
    return degrees * (kPi / 180);
}

/// Pi is 180 degrees.
constexpr double degreesFromRadians(double radians) {
    return radians * 180 / kPi;
}

} // namespace gnomon
