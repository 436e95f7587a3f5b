// Vertex pairs: nearby positions of different connected components. They may collapse into each other although they
// have no common edge (the non-edge pairs of Garland, Heckbert 1997).
#pragma once

#include "preprocess/simplify/patch.h"

namespace gnomon::simplify {

/// Returns for each position of `patch` its partner, which is the nearest position of another connected component. The
/// partner is kNone for locked positions and for positions of large components. Returns an empty list if there are no
/// pairs.
std::vector<std::uint32_t> vertexPairs(const Patch& patch);

} // namespace gnomon::simplify
