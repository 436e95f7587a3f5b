// Layers: parallel faces of different colours, one close behind the other, whose order a collapse must not change.
#pragma once

#include "preprocess/simplify/patch.h"

namespace gnomon::simplify {

/// How far a triangle may move along its normal before it can reach a layer of another colour, and what it costs then.
struct LayerGap {
    float reach = std::numeric_limits<float>::infinity(); // grid steps: a bit less than half the distance to the layer
    float charge = 0;                                     // grid steps: of the whole triangle in the layer's colour
};

/// Returns the gap of each triangle of `patch`; empty if there are no layers. Only triangles of one colour each count.
/// A layer lies before or behind a point of the triangle, no farther than the triangle is wide, and faces the same way;
/// behind, it may also face away, as the other side of a sheet does. Two faces that face each other are no layers:
/// nobody sees either.
std::vector<LayerGap> layerGaps(const Patch& patch);

} // namespace gnomon::simplify
