// Reads the source of a model as triangles in local space, for the check of stored errors.
#pragma once

#include "core/progress.h"
#include "hierarchy/grid.h"
#include "preprocess/read/mesh_source.h"
#include "preprocess/verify/triangle_tree.h"

namespace gnomon::verify {

/// Reads all triangles of `source`. The function skips triangles that a build drops: two corners have the same grid
/// point, or a corner is outside the grid's range. `progress` advances by the triangles read, including the skipped
/// ones.
TriangleSoup readSoup(read::MeshSource& source, const hierarchy::Grid& grid, Progress& progress);

} // namespace gnomon::verify
