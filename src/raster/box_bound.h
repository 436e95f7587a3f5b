// Bounds of the pixels and depths that the triangles inside a box can cover, including the rounding of their vertices.
#pragma once

#include "raster/projection.h"

namespace gnomon::raster {

/// Bounds of the pixels and depths of all triangles whose corners are in a box.
struct BoxBound {
    PixelBox box;         // all pixels that the triangles can cover, also pixels outside the viewport
    float nearest = 1;    // upper bound of the pixel depths, in [0, 1]; with reversed depth, this is the nearest depth
    float min = 0;        // lower bound of the pixel depths, in [0, 1]
    bool isWhole = false; // true: no vertex needs clipping; false: the other members are undefined
};

/// Returns the bounds of the pixels and depths of all triangles in `box`. The bounds include the rounding errors of the
/// vertex stage, which uses float arithmetic. Each clip-space coordinate is a sum of four terms with at most five
/// roundings. Its error is at most 5 x 2^-24 of the sum of the terms' magnitudes (Higham 2002, section 3.1).
BoxBound boxBound(const Projection& projection, const CellBox& box);

} // namespace gnomon::raster
