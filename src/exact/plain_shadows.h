// Exact shadows without a fast path: each sample against each triangle near its ray, in integers alone. The truth that
// pictures are held against.
#pragma once

#include "exact/caster_kernel.h"

#include <vector>

namespace gnomon::exact {

/// The status of each of `samples`, as ExactShadows finds them, by `meet` with every triangle whose box on the light
/// plane comes near the sample's; where `isAsked` is not empty, of those samples that it has no 0 for, the others are
/// lit. Takes as much memory as the triangles' boxes, 40 bytes each and more.
std::vector<std::uint8_t> plainStatuses(
    const SampleList& samples,
    std::span<const Caster> casters,
    const glm::uvec3& originCell,
    std::span<const std::uint8_t> isAsked = {});

/// The same of samples whose space has a point light: by `meetTowards` with every triangle whose box, seen from the
/// light through the faces of a cube, comes near the sample's place there.
std::vector<std::uint8_t> plainPointStatuses(
    const SampleList& samples,
    std::span<const Caster> casters,
    const glm::uvec3& originCell,
    std::span<const std::uint8_t> isAsked = {});

} // namespace gnomon::exact
