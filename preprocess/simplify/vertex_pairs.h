// Vertex pairs: nearby positions of different connected components, which may collapse into each other though no edge
// joins them (the non-edge pairs of Garland and Heckbert 1997).
#pragma once

#include "preprocess/simplify/patch.h"

namespace gnomon::simplify {

/// For each position of `patch` the nearest one of another connected component, or kNone for locked positions and those
/// of large components; empty if there are no pairs.
std::vector<std::uint32_t> vertexPairs(const Patch& patch);

} // namespace gnomon::simplify
