// Transfers vertex normals from a patch to its simplified version.
#pragma once

#include "preprocess/simplify/patch.h"

namespace gnomon::levels {

/// A vertex index and the new packed normal of this vertex.
struct TransferredNormal {
    std::uint32_t vertex = 0;
    std::uint32_t normal = 0;
};

/// Returns the changed vertex normals of `simplified`, by ascending vertex. The function makes one step of a
/// least-squares fit of the interpolated normals to the original normals over the area of `patch`. If the
/// simplification removes the relief of a surface, shading therefore uses the mean of the original normals. Without the
/// fit it would use the normals that happen to be at the remaining vertices. Vertices at locked positions and vertices
/// without a normal do not change. Normals more than 60 degrees apart do not affect each other.
std::vector<TransferredNormal> transferredNormals(
    const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

} // namespace gnomon::levels
