// Cutting one triangle in homogeneous space, for those that cannot be divided as they are.
#pragma once

#include "raster/projection.h"

namespace gnomon::raster {

/// A triangle cut by six planes has at most nine corners; where rounding makes it wavy, each plane adds at most half.
struct ClippedPolygon {
    std::array<SnappedVertex, 32> corners{};
    std::size_t count = 0; // less than 3: nothing is left
};

/// What is left of a triangle inside the guard band (which lies in w >= 0) and, where depth is cut, between the planes.
/// Corners that need no cut keep the very bits of `snapped`, and an edge is cut the same way from both of its sides, so
/// that neighbours still meet exactly.
ClippedPolygon clipTriangle(const Projection& projection, const std::array<ClipPosition, 3>& triangle);

} // namespace gnomon::raster
