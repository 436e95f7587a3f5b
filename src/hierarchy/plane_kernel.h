// Numbers that lie byte plane by byte plane, unfolded in vector lanes.
#pragma once

#include "hierarchy/vertex_numbers.h"

#include <span>

namespace gnomon::hierarchy {

/// Numbers of one kind.
struct Planes {
    const std::uint8_t* bytes = nullptr; // `planes` planes of `numbers` bytes, lowest first
    unsigned planes = 0;                 // at most 4
    std::size_t numbers = 0;
};

/// These write to whole vectors: up to kMostLanes elements more than there are numbers, all planes alike.

/// The numbers as they are.
void unfoldNumbers(const Planes& planes, std::uint32_t* out);

/// Zigzag-coded differences, by coordinate; the fourth word is 0.
void unfoldPositions(std::span<const Planes, 3> planes, PositionWords* out);

/// Zigzag-coded differences, joined and masked.
void unfoldNormals(std::span<const Planes, 2> planes, std::uint32_t mask, std::uint64_t* out);

/// Zigzag-coded differences modulo 256, red in the low byte.
void unfoldColors(std::span<const Planes, 4> planes, std::uint32_t* out);

} // namespace gnomon::hierarchy
