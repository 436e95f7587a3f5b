// Normals of corners: their octahedral code, and smooth ones for sources that bring none.
#pragma once

#include "preprocess/build/mesh.h"

namespace gnomon::preprocess {

/// Octahedral code of a direction (need not be of unit length) in two snorm16, x in the low half; kNoNormal for zero.
/// Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 2014.
std::uint32_t encodeNormal(const glm::dvec3& direction);

/// The unit vector of a code, zero for kNoNormal.
glm::dvec3 decodeNormal(std::uint32_t code);

/// Gives each position the area-weighted mean of its faces' normals where all of them are within 40 degrees of it, and
/// kNoNormal elsewhere. `positions` (grid points) and `triangles` of position ids.
std::vector<std::uint32_t> smoothNormals(
    const std::vector<GridPoint>& positions, const std::vector<Triangle>& triangles);

} // namespace gnomon::preprocess
