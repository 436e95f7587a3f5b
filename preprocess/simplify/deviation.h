// How far a simplified patch and the source that it stands for are apart: a bound, not an estimate.
#pragma once

#include "preprocess/simplify/patch.h"

namespace gnomon::simplify {

struct Deviation {
    std::vector<TriangleError> errors; // of the simplified triangles
    double worst = 0;                  // the largest of them
};

/// Bounds the two-sided distance between the source and `simplified`, given the bounds `patch.errors` of the patch's
/// own triangles. Each triangle of one side is cut into convex pieces, each piece is assigned to one triangle of the
/// other side, and since the distance to a convex set is a convex function, the piece's corners bound all of it: no
/// samples, no covering radius. Pieces whose bound is at most `goal` (grid steps) are not cut further, and simplified
/// triangles whose own bound towards the source is no more keep it. Every source point is mapped to exactly one chain
/// of triangles through the levels, so the bound holds for every cut, not only for uniform ones.
Deviation measureDeviation(const Patch& patch, const SimplifiedPatch& simplified, double goal);

} // namespace gnomon::simplify
