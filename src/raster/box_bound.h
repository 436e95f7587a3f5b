// Bounds of the image of a grid box, in pixels and depth, for any rounding of its vertices.
#pragma once

#include "raster/projection.h"

namespace gnomon::raster {

/// Bounds of all triangles whose corners lie in a box.
struct BoxBound {
    PixelBox box;         // all pixels that the triangles can cover, also outside the viewport
    float nearest = 1;    // with reversed depth: upper bound of the depth of their pixels; 0 to 1
    float min = 0;        // lower bound of that depth; 0 to 1
    bool isWhole = false; // true: no vertex needs clipping; false: the other members are undefined
};

/// Returns the bounds of `box`. Vertices are snapped in float arithmetic, and the bounds include the rounding errors.
/// Each clip-space coordinate is a sum of four terms with at most five roundings. Its error is at most 5 x 2^-24 of the
/// sum of their magnitudes (Higham 2002, section 3.1).
BoxBound boxBound(const Projection& projection, const CellBox& box);

} // namespace gnomon::raster
