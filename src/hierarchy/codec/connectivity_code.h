// The code of the triangles of a cluster, which the encoder and the decoder share. A triangle is entered if it
// continues across an open edge, which is an edge of an earlier triangle. Each triangle has one code byte.
// - The high nibble is the age of the open edge across which the triangle is entered. It is 15 if the triangle is not
//   entered. The first two corners of an entered triangle are the ends of this edge.
// - The low nibble of an entered triangle describes the third corner. 0 means the next new vertex. 1 to 14 mean the
//   vertex that many places before the next new one. 15 means that the index follows in the second stream.
// - The low nibble of a triangle that is not entered has three bits. Bit k is set if corner k is the next new vertex.
//   Otherwise the index of the corner follows in the second stream.
#pragma once

#include <cstdint>

namespace gnomon::hierarchy {

constexpr unsigned kNotEntered = 15; // instead of the age of an edge
constexpr unsigned kExplicit = 15;   // instead of the distance of a third corner

} // namespace gnomon::hierarchy
