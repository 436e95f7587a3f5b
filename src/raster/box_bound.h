// What the image of a box of the grid stays within: pixels and depth, however its vertices are rounded.
#pragma once

#include "raster/projection.h"

namespace gnomon::raster {

/// Bounds of what triangles with all their corners in a box can draw.
struct BoxBound {
    PixelBox box;         // every pixel whose centre they may cover, inside the viewport or not
    float nearest = 1;    // no less than any depth that a pixel takes of them, where depths are reversed; 0 to 1
    float least = 0;      // no more than any such depth; 0 to 1
    bool isWhole = false; // surely no vertex needs to be cut; else nothing is known of the box
};

/// The bounds of `box`. Vertices are snapped in floats; what their roundings can move them by is within the bounds:
/// each coordinate in clip space is a sum of four terms with at most five roundings, so it is off by at most 5 x 2^-24
/// of the sum of their magnitudes (Higham 2002, 3.1).
BoxBound boxBound(const Projection& projection, const CellBox& box);

} // namespace gnomon::raster
