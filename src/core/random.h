// A seeded generator whose sequence is the same everywhere (the standard library's distributions are not).
#pragma once

#include <cstdint>

namespace gnomon {

/// One step of SplitMix64 (Steele, Lea, Flood 2014): a bijective mix of 64 bits, usable as a hash.
constexpr std::uint64_t mix64(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15ULL;
    x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
    return x ^ (x >> 31U);
}

/// A SplitMix64 sequence.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        const std::uint64_t result = mix64(state_);
        state_ += 0x9E3779B97F4A7C15ULL;
        return result;
    }

    /// Uniform in [0, 1).
    double unit() { return static_cast<double>(bits() >> 11U) * 0x1.0p-53; }

    /// Uniform in [low, high).
    double uniform(double low, double high) { return low + (high - low) * unit(); }

    /// In [0, count), uniform but for a bias of count / 2^64; `count` at least 1.
    std::uint64_t below(std::uint64_t count) { return bits() % count; }

private:
    std::uint64_t state_;
};

} // namespace gnomon
