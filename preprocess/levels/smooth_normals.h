// Smooth normals for sources that bring none.
#pragma once

#include "preprocess/simplify/mesh.h"

namespace gnomon::levels {

/// Gives each position the area-weighted mean of its faces' normals where all of them are within 40 degrees of it, and
/// kNoNormal elsewhere. `positions` (grid points) and `triangles` of position ids.
std::vector<std::uint32_t> smoothNormals(
    const std::vector<hierarchy::GridPoint>& positions, const std::vector<simplify::Triangle>& triangles);

} // namespace gnomon::levels
