// Checks that a simplified patch has the same number of triangles at each edge between locked positions. Neighbouring
// groups rely on these triangles.
#pragma once

#include "preprocess/simplify/patch.h"

namespace gnomon::simplify {

/// Returns true if each edge between two locked positions has the same number of triangles in `triangles` and in the
/// patch. Returns false also if `triangles` contains a new edge between locked positions, because the neighbouring
/// group could create the same edge and lose it later.
bool keepsLockedEdges(const Patch& patch, const std::vector<Triangle>& triangles);

/// Returns one flag per position: 1 for the locked positions of the patch and all neighbours of these positions. A
/// simplifier that moves none of them preserves the faces at all locked edges.
std::vector<std::uint8_t> lockedWithRing(const Patch& patch);

} // namespace gnomon::simplify
