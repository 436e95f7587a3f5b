// Whether a simplified patch kept what other groups count on: the faces at every edge between locked positions.
#pragma once

#include "preprocess/build/patch.h"

namespace gnomon::preprocess {

/// True if each edge of the patch between two locked positions has as many of `triangles` as of the patch's own. Edges
/// that are new between locked positions are nobody else's.
bool keepsLockedEdges(const Patch& patch, const std::vector<Triangle>& triangles);

} // namespace gnomon::preprocess
