// Computes the cut of a frame on all cores, with its draw lists: one list for the image, and one list of casters per
// partition.
#pragma once

#include "lod/cut.h"

namespace gnomon::lod {

/// Returns the same cut as lod::cut, bit-identical and in the same order, but computed on all cores.
lod::Cut cutFrame(const lod::CutQuery& query);

/// Converts `volume` from camera space (left-handed, eye at 0) to the model's local space.
ConvexVolume localVolume(const ConvexVolume& volume, const lod::DetailView& view);

} // namespace gnomon::lod
