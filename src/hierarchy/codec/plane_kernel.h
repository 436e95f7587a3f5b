// Decoding of numbers that are stored byte plane by byte plane, with vector instructions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::hierarchy {

/// The max number of lanes. Arrays of words per vertex are read and written in whole vectors, so they need this many
/// additional words.
constexpr std::size_t kMaxLanes = 16;

/// Three differences of a position and an unused word, so that one vector instruction loads or adds all of them.
struct alignas(16) PositionWords {
    std::array<std::uint32_t, 4> word;
};

/// Returns both components of a normal in one word, so that one operation predicts both.
constexpr std::uint64_t joinedNormal(std::uint32_t x, std::uint32_t y) {
    return std::uint64_t{y} << 32U | x;
}

/// The byte planes of one channel.
struct Planes {
    const std::uint8_t* bytes = nullptr; // `planes` planes of `numbers` bytes, the lowest first
    unsigned planes = 0;                 // at most 4
    std::size_t numbers = 0;
};

/// The following functions write whole vectors: up to kMaxLanes elements after the last number. All `planes` of a call
/// have the same number of elements.

/// Decodes plain numbers.
void decodeNumbers(const Planes& planes, std::uint32_t* out);

/// Decodes zigzag-coded differences, one channel per coordinate. The fourth word is 0.
void decodePositions(std::span<const Planes, 3> planes, PositionWords* out);

/// Decodes zigzag-coded differences of normals, joined and masked.
void decodeNormals(std::span<const Planes, 2> planes, std::uint32_t mask, std::uint64_t* out);

/// Decodes zigzag-coded differences of colours modulo 256. Red is in the low byte.
void decodeColors(std::span<const Planes, 4> planes, std::uint32_t* out);

} // namespace gnomon::hierarchy
