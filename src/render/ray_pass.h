// Computes the shadows of visible points by ray tracing. Points and tolerance are the same as for exact shadows.
#pragma once

#include "raytrace/kept_trees.h"
#include "render/exact_pass.h"

#include <span>
#include <vector>

namespace gnomon::render {

/// Computes the shadow of each sample by ray tracing. The result is exact::kDark if the ray to the light hits a
/// triangle of `scene` beyond the tolerance, otherwise exact::kLit. Triangle ids of samples refer to the clusters in
/// `drawn`. Rays use the single precision of Embree, but an integer test ignores triangles in the plane of the sample.
std::vector<std::uint8_t> tracedStatuses(
    const DrawInputs& frame,
    const raytrace::CutScene& scene,
    const exact::SampleList& samples,
    std::span<const DrawnCluster> drawn);

} // namespace gnomon::render
