// Interval arithmetic that holds in every rounding mode, since it sets none: each result is widened by more than any
// mode can be off.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::selection {

/// All numbers from `low` to `high`, which may be infinite.
struct Range {
    double low = 0;
    double high = 0;

    Range() = default;

    Range(double exact) : low(exact), high(exact) {} // NOLINT(google-explicit-constructor): constants of formulas

    Range(double least, double most) : low(least), high(most) {}
};

/// `range`, whose ends are each a rounded result, widened by four times what that may be off.
inline Range widened(const Range& range) {
    constexpr double kRounding = 0x1p-50;
    constexpr double kUnderflow = std::numeric_limits<double>::min();
    const double down = std::abs(range.low) * kRounding + kUnderflow;
    const double up = std::abs(range.high) * kRounding + kUnderflow;
    return {
        std::isinf(range.low) ? range.low : range.low - down, std::isinf(range.high) ? range.high : range.high + up};
}

inline Range operator-(const Range& a) {
    return {-a.high, -a.low};
}

inline Range operator+(const Range& a, const Range& b) {
    return widened({a.low + b.low, a.high + b.high});
}

inline Range operator-(const Range& a, const Range& b) {
    return a + -b;
}

inline Range operator*(const Range& a, const Range& b) {
    const auto product = [](double x, double y) { return x == 0 || y == 0 ? 0 : x * y; }; // of 0 and infinity, too
    const auto [low, high] =
        std::minmax({product(a.low, b.low), product(a.low, b.high), product(a.high, b.low), product(a.high, b.high)});
    return widened({low, high});
}

/// All numbers where `b` holds 0.
inline Range operator/(const Range& a, const Range& b) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (b.low <= 0 && b.high >= 0) return {-kInfinity, kInfinity};
    return a * widened({1 / b.high, 1 / b.low});
}

inline Range least(const Range& a, const Range& b) {
    return {std::min(a.low, b.low), std::min(a.high, b.high)};
}

inline Range greatest(const Range& a, const Range& b) {
    return {std::max(a.low, b.low), std::max(a.high, b.high)};
}

/// Of what is not below 0 in `a`.
inline Range root(const Range& a) {
    const Range wide = widened({std::sqrt(std::max(a.low, 0.0)), std::sqrt(std::max(a.high, 0.0))});
    return {std::max(wide.low, 0.0), wide.high};
}

/// All that is in either.
inline Range hull(const Range& a, const Range& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

} // namespace gnomon::selection
