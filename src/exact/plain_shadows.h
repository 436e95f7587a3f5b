// Exact shadows by brute force: tests each sample against each triangle near its ray, with integers only. The results
// are the ground truth for pictures.
#pragma once

#include "exact/caster_kernel.h"

#include <vector>

namespace gnomon::exact {

/// Returns the status of each sample for a directional light, equal to the result of ExactShadows. The function calls
/// `intersect` for each triangle whose box on the light plane is near the sample. If `isRequested` is not empty, only
/// samples with a non-zero entry are tested, and all others are lit. The boxes need at least 40 bytes of memory per
/// triangle.
std::vector<std::uint8_t> plainStatuses(
    const SampleList& samples,
    std::span<const Caster> casters,
    const glm::uvec3& originCell,
    std::span<const std::uint8_t> isRequested = {});

/// Returns the status of each sample for a point light. The function calls `intersectTowards` for each triangle whose
/// box, projected onto a face of the cube around the light, is near the sample.
std::vector<std::uint8_t> plainPointStatuses(
    const SampleList& samples,
    std::span<const Caster> casters,
    const glm::uvec3& originCell,
    std::span<const std::uint8_t> isRequested = {});

} // namespace gnomon::exact
