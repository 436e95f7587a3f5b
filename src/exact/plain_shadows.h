// Exact shadows by brute force: tests each sample against each triangle near its light ray, with integers only. The
// results are the ground truth for images.
#pragma once

#include "exact/caster_kernel.h"

#include <vector>

namespace gnomon::exact {

/// Returns the shadow result of each sample for a directional light, by brute force. The results are equal to those of
/// ExactShadows. The function calls `intersect` for each triangle whose box on the light plane is near the sample. If
/// `isRequested` is not empty, the function tests only samples with a non-zero entry, and all others are lit. The
/// triangle boxes need at least 40 bytes per triangle.
std::vector<std::uint8_t> plainStatuses(
    const SampleList& samples,
    std::span<const Caster> casters,
    const glm::uvec3& originCell,
    std::span<const std::uint8_t> isRequested = {});

/// Returns the shadow result of each sample for a point light, by brute force. The function calls `intersectTowards`
/// for each triangle whose box, projected onto a face of the cube around the light, is near the sample.
std::vector<std::uint8_t> plainPointStatuses(
    const SampleList& samples,
    std::span<const Caster> casters,
    const glm::uvec3& originCell,
    std::span<const std::uint8_t> isRequested = {});

} // namespace gnomon::exact
