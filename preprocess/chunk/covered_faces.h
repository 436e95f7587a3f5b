// Faces that lie in the plane of an earlier face of another colour: the earlier one is seen, as in the source's order.
#pragma once

#include "preprocess/simplify/mesh.h"

namespace gnomon::chunk {

/// Removes from the faces of `mesh`, whose triangles are in the order of the source, the parts that earlier faces of
/// another colour cover in the same plane, so that nothing depends on how a renderer rounds depths. Returns how many
/// triangles lost a part or all of it; what is left of one takes its place, with new corners rounded to the grid.
///
/// Two faces lie in one plane if the corners of the smaller are in the plane of the larger, to within one and a half
/// grid steps if it is tilted. Only triangles of one colour count. Of faces that face each other a part is removed only
/// if both belong to open surfaces, and a whole triangle only if one does: the sides of solids in contact are not seen.
/// A triangle at the border of the mesh, or with too many covering ones, stays whole.
std::uint64_t removeCoveredFaces(simplify::Mesh& mesh);

} // namespace gnomon::chunk
