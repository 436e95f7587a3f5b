// Detects layers: nearby parallel triangles of different colours. A collapse must not change which of two layers is in
// front.
#pragma once

#include "preprocess/simplify/patch.h"

namespace gnomon::simplify {

/// The distance from a triangle to a nearby parallel surface of another colour (a layer).
struct LayerGap {
    // Max displacement in grid steps along the normal at which the triangle cannot touch the layer. It is slightly less
    // than half the distance.
    float reach = std::numeric_limits<float>::infinity();
    // Cost in grid steps of a larger displacement. It is the error if the whole triangle has the colour of the layer.
    float charge = 0;
};

/// Returns the distance of each triangle of `patch` to a layer (a nearby parallel face of another colour). Returns an
/// empty list if there are no layers. Only triangles whose corners have the same colour are considered. A layer is a
/// face in front of or behind a point of the triangle. Its distance is at most the triangle's width, and it has the
/// same orientation. A layer behind may also have the opposite orientation, as the other side of a sheet. Two faces
/// that face each other are not layers, because both are invisible.
std::vector<LayerGap> layerGaps(const Patch& patch);

} // namespace gnomon::simplify
