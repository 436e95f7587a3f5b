// Computes an upper bound of the two-sided Hausdorff distance between a simplified patch and the source mesh.
#pragma once

#include "preprocess/simplify/patch.h"

namespace gnomon::simplify {

/// The upper bounds of the Hausdorff distance between a simplified patch and the source mesh.
struct HausdorffBound {
    std::vector<TriangleError> errors; // errors of each simplified triangle
    double worst = 0;                  // max of both errors of all triangles
};

/// Returns an upper bound of the two-sided Hausdorff distance between the source mesh and `simplified`. `patch.errors`
/// bounds the errors of the original triangles. The function cuts each triangle of one side into convex pieces and
/// assigns each piece to one triangle of the other side. The distance to a convex set is a convex function, so the
/// corners of a piece bound the whole piece without sampling.
///
/// Pieces with a bound of at most `goal` (grid steps) are not cut further. If the simplifier's bound of a triangle
/// towards the source is at most `goal`, the function uses this bound. Each source point is mapped through exactly one
/// chain of triangles, one per level. The bound is therefore valid for each cut of the hierarchy, not only for uniform
/// cuts.
HausdorffBound measureHausdorffBound(const Patch& patch, const SimplifiedPatch& simplified, double goal);

} // namespace gnomon::simplify
