// From a fitted shadow map to what the error rule must know of it: volumes and texels in the model's local space.
#pragma once

#include "selection/error_rule.h"
#include "shadow/setup.h"

namespace gnomon::culling {

/// One partition and its map, in camera space as `shadow` has it.
struct PartitionMap {
    shadow::WarpedMap map;
    shadow::Resolution resolution; // texels of the map; `image` does not matter
    ConvexVolume casters;
    ConvexVolume receivers;
    double receiverNear = 1e-6; // the least view depth among its receivers, above 0
};

/// The rule's view of `partition`; `view` must be the one whose camera space it is given in.
selection::CasterDetail casterDetail(const selection::DetailView& view, const PartitionMap& partition);

/// The same for one map of a frame's setup, whose rectangle has `gutter` texels around the map and may lie on its side.
selection::CasterDetail casterDetail(
    const selection::DetailView& view, const shadow::ShadowMapPartition& partition, int gutter);

} // namespace gnomon::culling
