// Removes hidden parts of coplanar faces of different colours, so that the earlier face of the source is visible.
#pragma once

#include "preprocess/simplify/mesh.h"

namespace gnomon::chunk {

/// Removes the parts of faces of `mesh` that earlier coplanar faces of another colour cover. Without this step the
/// visible colour would depend on depth rounding (z-fighting). The triangles must be in source order. Returns the
/// number of triangles that lost a part or were removed. The remaining parts of a triangle take its place, with new
/// corners rounded to the grid.
///
/// Two faces are coplanar if the corners of the smaller face lie in the plane of the larger one. The tolerance is 1.5
/// grid steps for tilted planes. Only triangles of one colour count. Two faces of opposite orientation lose a part only
/// if both belong to open surfaces. They lose a whole triangle if at least one surface is open. The reason: the
/// touching sides of two solids are invisible. A triangle at the border of the mesh, or with too many covering
/// triangles, does not change.
std::uint64_t removeCoveredFaces(simplify::Mesh& mesh);

} // namespace gnomon::chunk
