// The samples of exact shadows answered by rays: the same points, the same tolerance, another way to find out.
#pragma once

#include "executor/exact_pass.h"
#include "raycast/kept_trees.h"

#include <span>
#include <vector>

namespace gnomon::executor {

/// For each of `samples`, which name their triangles by the clusters of `drawn`, exact::kDark where a ray towards the
/// light meets a triangle of `scene` farther ahead than the sample's tolerance, by Embree's floats, else exact::kLit.
/// What lies in the very plane of the sample, by integers, is not met.
std::vector<std::uint8_t> tracedStatuses(
    const FrameDrawing& frame,
    const raycast::CutScene& scene,
    const exact::SampleList& samples,
    std::span<const DrawnCluster> drawn);

} // namespace gnomon::executor
