// Patches to simplify, and points on them: for the tests of simplifiers and of their errors.
#pragma once

#include "core/random.h"
#include "preprocess/simplify/patch.h"
#include "tests/read/code_mesh.h"

namespace gnomon::simplify {

/// The mesh as one patch in steps of a thousandth, with a fifth of it locked: what has x < 0.2.
Patch patchOf(const read::CodeMesh& mesh);

/// Boxes, a sheet across them, and lone triangles.
read::CodeMesh mixedMesh();

/// A patch of `triangles` over `positions`, one vertex at each, none locked.
Patch plainPatch(std::vector<glm::dvec3> positions, std::vector<Triangle> triangles);

/// A point of `triangle` (vertices of `patch`), uniform over it.
glm::dvec3 randomPoint(const Patch& patch, const Triangle& triangle, Random& random);

/// Whether `corner` is one of the three of `triangle`.
bool has(const Triangle& triangle, std::uint32_t corner);

/// The distance of `p` from `triangle` (vertices of `patch`).
double distanceTo(const Patch& patch, const glm::dvec3& p, const Triangle& triangle);

} // namespace gnomon::simplify
