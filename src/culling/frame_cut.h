// The cut of a frame on all cores, with its draw lists: one for the image and one of casters per partition.
#pragma once

#include "selection/cut.h"

namespace gnomon::culling {

/// Returns the same cut as selection::cut, to the last bit and in the same order, computed on all cores.
selection::Cut cutFrame(const selection::CutQuery& query);

/// Converts `volume` from camera space (left-handed, eye at 0) to the model's local space.
ConvexVolume localVolume(const ConvexVolume& volume, const selection::DetailView& view);

} // namespace gnomon::culling
