// The cut and every draw list of a frame on all cores: the image's and one of casters per partition.
#pragma once

#include "selection/cut.h"

namespace gnomon::culling {

/// What selection::cut answers, to the last bit and in the same order, made on all cores.
selection::Cut cutFrame(const selection::CutQuery& query);

/// `volume`, given in camera space (left-handed, eye at 0), in the model's local space.
ConvexVolume localVolume(const ConvexVolume& volume, const selection::DetailView& view);

} // namespace gnomon::culling
