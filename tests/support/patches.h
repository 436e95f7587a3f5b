// Patches and points on them, for tests of simplifiers and their error bounds.
#pragma once

#include "core/random.h"
#include "preprocess/simplify/patch.h"
#include "tests/support/code_mesh.h"

namespace gnomon::simplify {

/// Returns the mesh as one patch in steps of a thousandth. The vertices with x < 0.2, a fifth of the mesh, are locked.
Patch patchOf(const read::CodeMesh& mesh);

/// Returns a mesh of boxes, a sheet that intersects them, and isolated triangles.
read::CodeMesh mixedMesh();

/// Returns a patch of `triangles` over `positions`, with one unlocked vertex per position.
Patch plainPatch(std::vector<glm::dvec3> positions, std::vector<Triangle> triangles);

/// Returns a uniform random point of `triangle` (vertices of `patch`).
glm::dvec3 randomPoint(const Patch& patch, const Triangle& triangle, Random& random);

/// Returns true if `corner` is one of the three corners of `triangle`.
bool has(const Triangle& triangle, std::uint32_t corner);

/// Returns the distance between `p` and `triangle` (vertices of `patch`).
double distanceTo(const Patch& patch, const glm::dvec3& p, const Triangle& triangle);

} // namespace gnomon::simplify
