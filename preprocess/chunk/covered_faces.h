// Removes the hidden parts of coplanar faces with different colours. The face that is earlier in the source remains
// visible.
#pragma once

#include "preprocess/simplify/mesh.h"

namespace gnomon::chunk {

/// Removes hidden parts of the faces of `mesh`: the parts that an earlier coplanar face of another colour covers.
/// Without this step the visible colour would depend on depth rounding (z-fighting). The triangles must be in source
/// order. Returns the number of triangles that the function cut or removed. The remaining parts of a triangle replace
/// it in the list. Their new corners are rounded to the grid.
///
/// Two faces are coplanar if the corners of the smaller face lie in the plane of the larger face. The tolerance is 1.5
/// grid steps for tilted planes. Only triangles whose corners have the same colour are candidates. For two faces of
/// opposite orientation there are two rules:
/// - The later face is cut only if both faces belong to open surfaces.
/// - The later face is removed if it is covered completely and at least one of the surfaces is open. If both are
///   closed, it is unchanged, because the touching sides of two solids are invisible.
/// A triangle does not change if it is at the border of the mesh or has too many covering triangles.
std::uint64_t removeCoveredFaces(simplify::Mesh& mesh);

} // namespace gnomon::chunk
