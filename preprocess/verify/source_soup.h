// The source of a model as triangles in its local space: what stored errors are measured against.
#pragma once

#include "core/progress.h"
#include "hierarchy/grid.h"
#include "preprocess/read/mesh_source.h"
#include "preprocess/verify/triangle_tree.h"

namespace gnomon::verify {

/// Reads all of `source`. Triangles that a build drops, because two of their corners are the same grid point or because
/// a corner is beyond the grid's range, are left out. Progress advances by the triangles read, those left out included.
TriangleSoup readSoup(read::MeshSource& source, const hierarchy::Grid& grid, Progress& progress);

} // namespace gnomon::verify
