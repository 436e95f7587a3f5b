// Cuts the triangles of a model at section planes.
#pragma once

#include "core/convex_volume.h"
#include "preprocess/exporter/export.h"

#include <span>

namespace gnomon::sun {

/// Returns the triangles of `cut` on the inner side of all `planes` (in steps of the grid). If a plane intersects a
/// triangle, the inner piece replaces the triangle. The corners of pieces are rounded to the grid, identically for both
/// triangles at an edge. Clusters that no plane intersects are unchanged. In all other clusters, vertices keep only
/// their positions.
exporter::UniformCut sectionedCut(const exporter::UniformCut& cut, std::span<const Plane> planes);

} // namespace gnomon::sun
