// Simplifying one patch: the simplifiers to choose from, behind one call.
#pragma once

#include "preprocess/simplify/patch.h"

#include <string_view>

namespace gnomon::simplify {

enum class Simplifier { Own, Meshopt, OpenMesh };

/// Reduces `patch` to about `targetTriangles` (at least 1) triangles by moving vertices onto others; locked positions
/// stay. Pure: the same patch gives the same answer everywhere.
SimplifiedPatch simplify(const Patch& patch, std::size_t targetTriangles, Simplifier simplifier);

/// Edge collapses in the order of their quadric error (Garland and Heckbert 1997), each onto one of its ends. Open
/// edges and creases resist by planes of their own. Faces never turn over. Where the topology has to change (small
/// pieces merge or vanish, thin ones flatten), a collapse must be twice as cheap in distance to be chosen.
SimplifiedPatch simplifyOwn(const Patch& patch, std::size_t targetTriangles);

/// meshoptimizer's, with vertices locked by doubled dummy triangles on them.
SimplifiedPatch simplifyMeshopt(const Patch& patch, std::size_t targetTriangles);

/// OpenMesh's Decimater with the quadric module, locked vertices and open edges.
SimplifiedPatch simplifyOpenMesh(const Patch& patch, std::size_t targetTriangles);

} // namespace gnomon::simplify
