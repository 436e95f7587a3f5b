// Simplifies one patch (a group of clusters) with the quadric simplifier or with one of two reference simplifiers.
#pragma once

#include "preprocess/simplify/patch.h"

#include <string_view>

namespace gnomon::simplify {

/// The available methods of mesh simplification.
enum class Simplifier { Quadric, Meshopt, OpenMesh };

/// Reduces `patch` to about `targetTriangles` (at least 1) triangles. Vertices collapse only onto other vertices of the
/// patch. Locked positions do not move. The function is pure: it returns the same result for the same patch on all
/// machines.
SimplifiedPatch simplify(const Patch& patch, std::size_t targetTriangles, Simplifier simplifier);

/// Simplifies `patch` by half-edge collapses, cheapest first. The cost is based on quadric errors and error bounds.
/// simplify_quadric.cpp describes the method and its sources. A collapse that changes the topology costs twice its
/// distance. Examples are small components that merge or vanish, and thin components that become flat.
SimplifiedPatch simplifyQuadric(const Patch& patch, std::size_t targetTriangles);

/// Simplifies `patch` with meshoptimizer. Pairs of equal dummy triangles prevent meshoptimizer from moving locked
/// vertices.
SimplifiedPatch simplifyMeshopt(const Patch& patch, std::size_t targetTriangles);

/// Simplifies `patch` with OpenMesh's Decimater and its quadric module. Locked vertices and open edges do not move.
SimplifiedPatch simplifyOpenMesh(const Patch& patch, std::size_t targetTriangles);

} // namespace gnomon::simplify
