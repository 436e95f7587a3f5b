// Welded meshes to build levels of, and what can be told of a level at a glance.
#pragma once

#include "preprocess/levels/level.h"
#include "tests/read/code_mesh.h"

#include <vector>

namespace gnomon::levels {

/// `source` in steps of 2^-10 from (-1, -1, -1), one vertex at each position; no triangle outside shares anything.
simplify::Mesh meshOf(const read::CodeMesh& source);

/// The triangles [first, first + count) of `level` as sorted triples of grid points, in order: what they are whatever
/// their vertices are called.
using Corners = std::array<hierarchy::GridPoint, 3>;
std::vector<Corners> cornersOf(const simplify::Mesh& mesh, const Level& level, std::size_t first, std::size_t count);

/// All of a level's.
std::vector<Corners> cornersOf(const simplify::Mesh& mesh, const Level& level);

/// The group that each triangle of `level` is in.
std::vector<std::uint32_t> groupOfTriangles(const Level& level);

} // namespace gnomon::levels
