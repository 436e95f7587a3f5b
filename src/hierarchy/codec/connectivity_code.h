// The triangles of a cluster as codes: what encoder and decoder share.
//
// One code byte a triangle. High nibble: the age of the open edge across which the triangle is entered (then its first
// two corners are that edge), or 15 for none. Low nibble, entered: 0 if the third corner is the next new vertex, 1-14
// if it is the vertex that many before the next new one, 15 if its index follows in the second stream. Not entered: bit
// k says that corner k is the next new vertex, else its index follows.
#pragma once

#include <cstdint>

namespace gnomon::hierarchy {

constexpr unsigned kNotEntered = 15; // as the age of an edge
constexpr unsigned kExplicit = 15;   // as the distance of a third corner

} // namespace gnomon::hierarchy
