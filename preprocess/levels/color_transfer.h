// Colour transfer: the colours of a simplified patch, fitted to those of the patch that it replaces, and what that
// leaves wrong.
#pragma once

#include "preprocess/simplify/patch.h"

namespace gnomon::levels {

/// A vertex, by its number in a patch or a mesh, and the colour that it takes.
struct TransferredColor {
    std::uint32_t vertex = 0;
    std::uint32_t color = 0; // RGBA8
};

struct ColorTransfer {
    std::vector<TransferredColor> colors; // of vertices that `simplified` keeps and that change, ascending
    double error = 0;                     // grid steps
};

/// The charge of what is `difference` (of a channel, 0..1) off in colour where vertices moved by `length`: how far the
/// wrong colour reaches, times what of the difference exceeds what is seen, in units of what a pixel may be wrong by.
double colorCharge(double length, double difference);

/// New colours for the vertices that `simplified` keeps: one step of a least squares fit, over the area of `patch`, of
/// what is interpolated between them to the colours that were there; so a pattern that is gone leaves its mean, and one
/// that is kept stays sharp. Vertices at locked positions keep their colours. The error is the largest `colorCharge`
/// over points of all triangles of `patch`, each compared with the nearest simplified triangle around what its corners
/// were collapsed into.
ColorTransfer transferredColors(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

} // namespace gnomon::levels
