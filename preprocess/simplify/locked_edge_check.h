// Whether a simplified patch kept what other groups rely on: the faces at every edge between locked positions.
#pragma once

#include "preprocess/simplify/patch.h"

namespace gnomon::simplify {

/// True if each edge between two locked positions has as many of `triangles` as of the patch's own. An edge that is new
/// between locked positions counts too: the group on its other side may make the same one, and lose it later.
bool keepsLockedEdges(const Patch& patch, const std::vector<Triangle>& triangles);

/// The patch's locks with all neighbours of locked positions locked as well: a simplifier that respects these keeps
/// locked edges.
std::vector<std::uint8_t> lockedWithRing(const Patch& patch);

} // namespace gnomon::simplify
