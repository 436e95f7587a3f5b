// What section planes leave of a uniform cut.
#pragma once

#include "core/convex_volume.h"
#include "preprocess/exporter/export.h"

#include <span>

namespace gnomon::daylight {

/// The triangles of `cut` on the inner side of all `planes`, which are in cells of the grid, and the pieces there of
/// those that a plane goes through, with corners rounded to the grid, alike on both sides of an edge. Clusters that no
/// plane touches stay as they are; vertices of the others have positions alone.
exporter::UniformCut sectionedCut(const exporter::UniformCut& cut, std::span<const Plane> planes);

} // namespace gnomon::daylight
