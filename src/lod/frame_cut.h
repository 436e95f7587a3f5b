// The cut of a frame on all cores, with its draw lists: one for the image and one of casters per partition.
#pragma once

#include "lod/cut.h"

namespace gnomon::lod {

/// Returns the same cut as lod::cut, to the last bit and in the same order, computed on all cores.
lod::Cut cutFrame(const lod::CutQuery& query);

/// Converts `volume` from camera space (left-handed, eye at 0) to the model's local space.
ConvexVolume localVolume(const ConvexVolume& volume, const lod::DetailView& view);

} // namespace gnomon::lod
