// Rasterises the triangles of a cluster into the sample grid, and tests them against the samples in the covered cells.
#pragma once

#include "exact/caster_context.h"

namespace gnomon::exact {

/// Rasterises one cluster into the sample grids of all maps. Can run on any thread.
void rasterizeCluster(const CasterContext& context, std::size_t caster, CasterCounts& counts);

/// Returns the corners of triangle `triangle` of a caster, in cells from the origin.
Corners cornersOf(const CasterContext& context, const Caster& caster, std::size_t triangle);

/// Returns the corners of the triangle that contains the sample at position `place` of the grid, in cells from the
/// origin.
Corners ownCorners(const CasterContext& context, std::size_t place);

/// Tests with integers whether triangle `triangle` of `caster` shadows the sample at position `place` of the grid.
/// Returns the status bits of the sample (kDark and others).
std::uint8_t resolveExactly(
    const CasterContext& context, const Caster& caster, std::size_t triangle, std::size_t place);

} // namespace gnomon::exact
