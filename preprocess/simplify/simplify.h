// Simplifies one patch, by the quadric simplifier or by one of two reference simplifiers.
#pragma once

#include "preprocess/simplify/patch.h"

#include <string_view>

namespace gnomon::simplify {

/// The available simplifiers.
enum class Simplifier { Quadric, Meshopt, OpenMesh };

/// Reduces `patch` to about `targetTriangles` (at least 1) triangles by collapses onto other vertices. Locked positions
/// do not move. The function is pure: the same patch gives the same result on all machines.
SimplifiedPatch simplify(const Patch& patch, std::size_t targetTriangles, Simplifier simplifier);

/// Simplifies by half-edge collapses in the order of their cost, with quadric errors and error bounds.
/// simplify_quadric.cpp describes the method and its sources. A collapse that changes the topology costs twice its
/// distance. Examples are small components that merge or vanish, and thin components that become flat.
SimplifiedPatch simplifyQuadric(const Patch& patch, std::size_t targetTriangles);

/// Simplifies with meshoptimizer. Duplicate dummy triangles lock the locked vertices.
SimplifiedPatch simplifyMeshopt(const Patch& patch, std::size_t targetTriangles);

/// Simplifies with OpenMesh's Decimater and its quadric module. Locked vertices and open edges do not move.
SimplifiedPatch simplifyOpenMesh(const Patch& patch, std::size_t targetTriangles);

} // namespace gnomon::simplify
