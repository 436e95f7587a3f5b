// Clipping of one triangle in homogeneous space, for triangles that cannot be projected directly.
#pragma once

#include "raster/projection.h"

namespace gnomon::raster {

/// A clipped triangle. Six planes give at most nine corners. If rounding makes the polygon non-convex, a plane adds at
/// most half as many corners again.
struct ClippedPolygon {
    std::array<SnappedVertex, 32> corners{};
    std::size_t count = 0; // less than 3: the polygon is empty
};

/// Clips a triangle to the guard band (which lies in w >= 0) and, if depth is clipped, to the depth range. Corners that
/// need no clipping have exactly the bits of `snapped`. Both triangles at an edge clip it identically, so neighbours
/// still match exactly.
ClippedPolygon clipTriangle(const Projection& projection, const std::array<ClipPosition, 3>& triangle);

} // namespace gnomon::raster
