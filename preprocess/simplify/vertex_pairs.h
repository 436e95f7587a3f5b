// Vertex pairs: nearby positions of different connected components. They may collapse into each other without a common
// edge (the non-edge pairs of Garland, Heckbert 1997).
#pragma once

#include "preprocess/simplify/patch.h"

namespace gnomon::simplify {

/// Returns for each position of `patch` the nearest position of another connected component. The result is kNone for
/// locked positions and positions of large components, or an empty list if there are no pairs.
std::vector<std::uint32_t> vertexPairs(const Patch& patch);

} // namespace gnomon::simplify
