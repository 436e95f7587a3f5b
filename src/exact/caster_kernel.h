// Tests the triangles of a cluster against the samples of exact shadows. Only samples in the grid cells that a
// triangle covers are tested.
#pragma once

#include "exact/caster_context.h"

namespace gnomon::exact {

/// Tests all triangles of cluster `caster` against the samples in the cells that they cover, in all maps. Sets the
/// status bits of the samples. Can run on any thread.
void rasterizeCluster(const CasterContext& context, std::size_t caster, CasterCounts& counts);

/// Returns the three corners of triangle `triangle` of the cluster `caster`, in cells from the frame's origin.
Corners cornersOf(const CasterContext& context, const Caster& caster, std::size_t triangle);

/// Returns the corners of the triangle on which the sample at index `place` of the sample grid lies, in cells from the
/// frame's origin.
Corners ownCorners(const CasterContext& context, std::size_t place);

/// Tests with integers whether triangle `triangle` of `caster` shadows the sample at index `place` of the sample grid.
/// Returns the status bits of the sample, for example kDark.
std::uint8_t resolveExactly(
    const CasterContext& context, const Caster& caster, std::size_t triangle, std::size_t place);

} // namespace gnomon::exact
