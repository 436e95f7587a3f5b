// Smooth normals for sources that bring none.
#pragma once

#include "preprocess/build/mesh.h"

namespace gnomon::preprocess {

/// Gives each position the area-weighted mean of its faces' normals where all of them are within 40 degrees of it, and
/// kNoNormal elsewhere. `positions` (grid points) and `triangles` of position ids.
std::vector<std::uint32_t> smoothNormals(
    const std::vector<GridPoint>& positions, const std::vector<Triangle>& triangles);

} // namespace gnomon::preprocess
