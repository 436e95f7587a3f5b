// Ray-traced shadows for the samples of exact shadows, with the same points and the same tolerance.
#pragma once

#include "raytrace/kept_trees.h"
#include "render/exact_pass.h"

#include <span>
#include <vector>

namespace gnomon::render {

/// Returns one status per sample of exact shadows. The status is exact::kDark if the ray towards the light hits a
/// triangle of `scene` beyond the tolerance, otherwise exact::kLit. The triangle ids of samples refer to the clusters
/// in `drawn`. Rays use the single precision of Embree, but an integer test ignores triangles in the plane of the
/// sample.
std::vector<std::uint8_t> tracedStatuses(
    const DrawInputs& frame,
    const raytrace::CutScene& scene,
    const exact::SampleList& samples,
    std::span<const DrawnCluster> drawn);

} // namespace gnomon::render
