// Detects layers: parallel faces of different colours at a small distance. A collapse must not change their order.
#pragma once

#include "preprocess/simplify/patch.h"

namespace gnomon::simplify {

/// The max displacement of a triangle along its normal before it can reach a layer of another colour, and the cost of a
/// larger displacement.
struct LayerGap {
    // Grid steps; slightly less than half the distance to the layer.
    float reach = std::numeric_limits<float>::infinity();
    float charge = 0; // grid steps; the error if the whole triangle has the colour of the layer
};

/// Returns the gap of each triangle of `patch`, or an empty list if there are no layers. Only triangles of one colour
/// count. A layer is in front of or behind a point of the triangle, at a distance of at most the triangle's width, and
/// has the same orientation. A layer behind may also have the opposite orientation, as the other side of a sheet. Two
/// faces that face each other are not layers, because both are invisible.
std::vector<LayerGap> layerGaps(const Patch& patch);

} // namespace gnomon::simplify
