// A seeded random generator that produces the same sequence on all platforms. The distributions of the standard
// library differ between platforms.
#pragma once

#include <cstdint>

namespace gnomon {

/// Returns the SplitMix64 mix of `x` (Steele, Lea, Flood 2014). It is a bijection on 64 bits and also serves as a hash.
constexpr std::uint64_t mix64(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15ULL;
    x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
    return x ^ (x >> 31U);
}

/// A random generator that produces the SplitMix64 sequence.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        const std::uint64_t result = mix64(state_);
        state_ += 0x9E3779B97F4A7C15ULL;
        return result;
    }

    /// Returns a uniform random number in [0, 1).
    double unit() { return static_cast<double>(bits() >> 11U) * 0x1.0p-53; }

    /// Returns a uniform random number in [low, high).
    double uniform(double low, double high) { return low + (high - low) * unit(); }

    /// Returns an almost uniform random integer in [0, count). `count` is at least 1. The relative error of each
    /// probability is at most count / 2^64.
    std::uint64_t below(std::uint64_t count) { return bits() % count; }

private:
    std::uint64_t state_;
};

} // namespace gnomon
