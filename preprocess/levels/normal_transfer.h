// Normal transfer: the vertex normals of a simplified patch, fitted to those of the patch that it replaces.
#pragma once

#include "preprocess/simplify/patch.h"

namespace gnomon::levels {

/// A vertex, by its number in a patch or a mesh, and the packed normal that it takes.
struct TransferredNormal {
    std::uint32_t vertex = 0;
    std::uint32_t normal = 0;
};

/// New normals for the vertices that `simplified` keeps, in ascending order: one step of a least squares fit, over the
/// area of `patch`, of what is interpolated between them to the normals that were there. So a surface whose relief is
/// gone is shaded as it was on average, not as it happened to be where vertices stayed. Vertices at locked positions
/// and those without a normal keep what they have; between normals more than 60 degrees apart nothing is transferred.
std::vector<TransferredNormal> transferredNormals(
    const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

} // namespace gnomon::levels
