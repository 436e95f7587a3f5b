// Ray tracing for the samples of exact shadows, with the same points and the same tolerance.
#pragma once

#include "raytrace/kept_trees.h"
#include "render/exact_pass.h"

#include <span>
#include <vector>

namespace gnomon::render {

/// Returns exact::kDark for each sample whose ray towards the light hits a triangle of `scene` beyond the tolerance,
/// otherwise exact::kLit. Samples name their triangles by the clusters of `drawn`. Rays use the floats of Embree, but
/// an integer test ignores triangles in the plane of the sample.
std::vector<std::uint8_t> tracedStatuses(
    const DrawInputs& frame,
    const raytrace::CutScene& scene,
    const exact::SampleList& samples,
    std::span<const DrawnCluster> drawn);

} // namespace gnomon::render
