// Simplifying one patch: the quadric simplifier and the two that it is compared with, behind one call.
#pragma once

#include "preprocess/simplify/patch.h"

#include <string_view>

namespace gnomon::simplify {

enum class Simplifier { Quadric, Meshopt, OpenMesh };

/// Reduces `patch` to about `targetTriangles` (at least 1) triangles by moving vertices onto others; locked positions
/// stay. Pure: the same patch gives the same answer everywhere.
SimplifiedPatch simplify(const Patch& patch, std::size_t targetTriangles, Simplifier simplifier);

/// Half-edge collapses by quadric error and bounded error, in the order of their cost; see simplify_quadric.cpp for the
/// method and its sources. Where the topology has to change (small components merge or vanish, thin ones flatten), a
/// collapse costs twice its distance.
SimplifiedPatch simplifyQuadric(const Patch& patch, std::size_t targetTriangles);

/// meshoptimizer's, with vertices locked by doubled dummy triangles on them.
SimplifiedPatch simplifyMeshopt(const Patch& patch, std::size_t targetTriangles);

/// OpenMesh's Decimater with the quadric module, locked vertices and open edges.
SimplifiedPatch simplifyOpenMesh(const Patch& patch, std::size_t targetTriangles);

} // namespace gnomon::simplify
