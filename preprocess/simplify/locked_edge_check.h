// Checks that a simplified patch preserves the faces at each edge between locked positions, because neighbouring groups
// rely on them.
#pragma once

#include "preprocess/simplify/patch.h"

namespace gnomon::simplify {

/// Returns true if each edge between two locked positions has the same number of faces in `triangles` and in the patch.
/// A new edge between locked positions also fails, because the neighbouring group could create the same edge and lose
/// it later.
bool keepsLockedEdges(const Patch& patch, const std::vector<Triangle>& triangles);

/// Returns the locks of the patch, with all neighbours of locked positions also locked. A simplifier that respects
/// these locks preserves all locked edges.
std::vector<std::uint8_t> lockedWithRing(const Patch& patch);

} // namespace gnomon::simplify
