// Welded meshes for building levels, and simple properties of a level.
#pragma once

#include "preprocess/levels/level.h"
#include "tests/support/code_mesh.h"

#include <vector>

namespace gnomon::levels {

/// Returns `source` with positions in steps of 2^-10 from (-1, -1, -1), and one vertex per position. No triangle
/// outside the mesh shares its vertices.
simplify::Mesh meshOf(const read::CodeMesh& source);

/// Returns the triangles [first, first + count) of `level` as sorted triples of grid points, in order. The result does
/// not depend on the numbering of vertices.
using Corners = std::array<hierarchy::GridPoint, 3>;
std::vector<Corners> cornersOf(const simplify::Mesh& mesh, const Level& level, std::size_t first, std::size_t count);

/// Returns all triangles of a level.
std::vector<Corners> cornersOf(const simplify::Mesh& mesh, const Level& level);

/// Returns the group of each triangle of `level`.
std::vector<std::uint32_t> groupOfTriangles(const Level& level);

} // namespace gnomon::levels
