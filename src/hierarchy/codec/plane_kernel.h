// Decodes numbers with SIMD instructions from byte planes. A byte plane contains one byte of each number.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::hierarchy {

/// The max number of SIMD lanes. Arrays with one word per vertex are read and written in whole vectors, so they need
/// this many additional words.
constexpr std::size_t kMaxLanes = 16;

/// The differences of the three coordinates of a position, and an unused word. With the fourth word, one SIMD
/// instruction loads or adds all differences.
struct alignas(16) PositionWords {
    std::array<std::uint32_t, 4> word;
};

/// Packs both components of a normal into one 64-bit word, so that one operation predicts both.
constexpr std::uint64_t joinedNormal(std::uint32_t x, std::uint32_t y) {
    return std::uint64_t{y} << 32U | x;
}

/// The byte planes of one channel of numbers, such as the x coordinates. A plane contains one byte of each number.
struct Planes {
    // `planes` byte planes of `numbers` bytes each. The plane of the lowest bytes is first.
    const std::uint8_t* bytes = nullptr;
    unsigned planes = 0; // number of planes, at most 4
    std::size_t numbers = 0;
};

/// The following functions write whole SIMD vectors, which reach up to kMaxLanes elements beyond the last number. All
/// Planes of one call have the same number of elements.

/// Decodes numbers that are stored without zigzag code, byte plane by byte plane.
void decodeNumbers(const Planes& planes, std::uint32_t* out);

/// Decodes zigzag-coded differences of positions from one channel per coordinate. The fourth word of each position
/// becomes 0.
void decodePositions(std::span<const Planes, 3> planes, PositionWords* out);

/// Decodes zigzag-coded differences of normals. Each result packs both components, masked by `mask` per component.
void decodeNormals(std::span<const Planes, 2> planes, std::uint32_t mask, std::uint64_t* out);

/// Decodes zigzag-coded differences of colours modulo 256. The lowest byte of each result is red.
void decodeColors(std::span<const Planes, 4> planes, std::uint32_t* out);

} // namespace gnomon::hierarchy
