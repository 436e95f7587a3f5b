// Computes smooth vertex normals for meshes without normals.
#pragma once

#include "preprocess/simplify/mesh.h"

namespace gnomon::levels {

/// Returns one packed normal per position: the area-weighted mean normal of the faces at the position. The normal is
/// kNoNormal if a face deviates more than 40 degrees from the mean. `positions` are grid points, and `triangles`
/// contain position indices.
std::vector<std::uint32_t> smoothNormals(
    const std::vector<hierarchy::GridPoint>& positions, const std::vector<simplify::Triangle>& triangles);

} // namespace gnomon::levels
