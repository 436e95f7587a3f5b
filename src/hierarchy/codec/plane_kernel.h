// Numbers that lie byte plane by byte plane, decoded in vector lanes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::hierarchy {

/// Arrays of words by vertex are read and written in whole vectors: they have room for this many more words.
constexpr std::size_t kMostLanes = 16;

/// Three differences of a position and a word that is none, so that all are loaded and added at once.
struct alignas(16) PositionWords {
    std::array<std::uint32_t, 4> word;
};

/// Both numbers of a normal in one word, so that both are predicted at once.
constexpr std::uint64_t joinedNormal(std::uint32_t x, std::uint32_t y) {
    return std::uint64_t{y} << 32U | x;
}

/// Numbers of one kind.
struct Planes {
    const std::uint8_t* bytes = nullptr; // `planes` planes of `numbers` bytes, lowest first
    unsigned planes = 0;                 // at most 4
    std::size_t numbers = 0;
};

/// These write to whole vectors: up to kMostLanes elements more than there are numbers, all planes alike.

/// The numbers as they are.
void decodeNumbers(const Planes& planes, std::uint32_t* out);

/// Zigzag-coded differences, by coordinate; the fourth word is 0.
void decodePositions(std::span<const Planes, 3> planes, PositionWords* out);

/// Zigzag-coded differences, joined and masked.
void decodeNormals(std::span<const Planes, 2> planes, std::uint32_t mask, std::uint64_t* out);

/// Zigzag-coded differences modulo 256, red in the low byte.
void decodeColors(std::span<const Planes, 4> planes, std::uint32_t* out);

} // namespace gnomon::hierarchy
