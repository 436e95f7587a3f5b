// Rasterises the triangles of a cluster into the sample grid, and resolves each sample that a triangle may shadow.
#pragma once

#include "exact/caster_context.h"

namespace gnomon::exact {

/// Rasterises one cluster into the sample grids of all maps. Can run on any thread.
void rasterizeCluster(const CasterContext& context, std::size_t caster, CasterCounts& counts);

/// Returns the corners of triangle `triangle` of a caster, in cells from the origin.
Corners cornersOf(const CasterContext& context, const Caster& caster, std::size_t triangle);

/// Returns the corners of the triangle that contains the sample at `place` in the grid.
Corners ownCorners(const CasterContext& context, std::size_t place);

/// Computes with integers how triangle `triangle` of `caster` affects the sample at `place` in the grid. Returns status
/// bits.
std::uint8_t resolveExactly(
    const CasterContext& context, const Caster& caster, std::size_t triangle, std::size_t place);

} // namespace gnomon::exact
