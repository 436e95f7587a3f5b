// Selects the clusters of a frame (its cut) on all cores: one list for the image, and one list of casters per shadow
// map.
#pragma once

#include "lod/cut.h"

namespace gnomon::lod {

/// Selects the clusters for `query` on all cores. The result is bit-identical to lod::cut, in the same order.
lod::Cut cutFrame(const lod::CutQuery& query);

/// Converts `volume` from camera space (left-handed, eye at 0) to the model's local space.
ConvexVolume localVolume(const ConvexVolume& volume, const lod::DetailView& view);

} // namespace gnomon::lod
