// Reads the source mesh of a model as triangles in local space. The check of stored errors compares these triangles
// with the model.
#pragma once

#include "core/progress.h"
#include "hierarchy/grid.h"
#include "preprocess/read/mesh_source.h"
#include "preprocess/verify/triangle_tree.h"

namespace gnomon::verify {

/// Reads all triangles of `source` except the triangles that a build drops. A build drops a triangle if two of its
/// corners have the same grid point, or if a corner is outside the grid's range. `progress` advances by the number of
/// triangles read, including dropped triangles.
TriangleSoup readSoup(read::MeshSource& source, const hierarchy::Grid& grid, Progress& progress);

} // namespace gnomon::verify
