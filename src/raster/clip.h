// Clips a triangle in homogeneous space, if it extends behind the eye or too far beyond the viewport to be projected
// directly.
#pragma once

#include "raster/projection.h"

namespace gnomon::raster {

/// The polygon that remains of a triangle after clipping. Clipping by six planes gives at most nine corners. If
/// rounding makes the polygon non-convex, a plane can add up to half as many corners as the polygon has.
struct ClippedPolygon {
    std::array<SnappedVertex, 32> corners{};
    std::size_t count = 0; // less than 3: the polygon is empty
};

/// Clips a triangle to the guard band and to w >= 0. If the projection clips depth, the function also clips to the
/// depth range. Corners that need no clipping are bit-identical to the result of `snapped`. Two triangles with a common
/// edge clip the edge identically, so no gap appears between them.
ClippedPolygon clipTriangle(const Projection& projection, const std::array<ClipPosition, 3>& triangle);

} // namespace gnomon::raster
