// The code of the triangles of a cluster, shared by encoder and decoder.
// Each triangle has one code byte.
// - The high nibble is the age of the open edge across which the triangle is entered, or 15 if it is not entered. The
//   first two corners of an entered triangle are the ends of this edge.
// - The low nibble of an entered triangle describes the third corner. 0 means the next new vertex. 1 to 14 mean the
//   vertex this many places before the next new one. 15 means that the index follows in the second stream.
// - The low nibble of a triangle that is not entered has three bits. Bit k is set if corner k is the next new vertex.
//   Otherwise the index of the corner follows in the second stream.
#pragma once

#include <cstdint>

namespace gnomon::hierarchy {

constexpr unsigned kNotEntered = 15; // as the age of an edge
constexpr unsigned kExplicit = 15;   // as the distance of a third corner

} // namespace gnomon::hierarchy
