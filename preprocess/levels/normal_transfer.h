// Transfers vertex normals from a patch to its simplified version.
#pragma once

#include "preprocess/simplify/patch.h"

namespace gnomon::levels {

/// A vertex, by its index in a patch or a mesh, with its new packed normal.
struct TransferredNormal {
    std::uint32_t vertex = 0;
    std::uint32_t normal = 0;
};

/// Returns new normals for the vertices of `simplified`, by ascending vertex. The function makes one step of a
/// least-squares fit of the interpolated normals to the original normals over the area of `patch`. A surface that lost
/// its relief is therefore shaded with its mean normal, not with the normals at the remaining vertices. Vertices at
/// locked positions and vertices without a normal do not change. Normals more than 60 degrees apart do not affect each
/// other.
std::vector<TransferredNormal> transferredNormals(
    const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

} // namespace gnomon::levels
