// Snapping the source to the grid and welding it: from what was read to a Mesh, every dropped triangle counted.
#pragma once

#include "preprocess/build/source_mesh.h"

namespace gnomon::preprocess {

/// The grid for `source`: the step is the largest power of two that is at most 2^-20 of the extent, 1/64 of the median
/// edge and a third of all but 0.002% of the edges, as far as coordinates below 2^31 allow.
Grid chooseGrid(const SourceMesh& source);

/// Snaps, welds by position, drops what CONTRACT.md names and nothing else, and gives every corner its normal and
/// colour. `source` is consumed. Reasons: `degenerate` (two corners are one vertex or have the same source position),
/// `collapsed_by_grid` (two corners in one cell), `doubled` (the same three positions as a triangle before it, in any
/// order), `not_a_polygon` (faces of fewer than three corners; they are no triangles and not in sourceTriangles).
Mesh weld(SourceMesh source);

} // namespace gnomon::preprocess
