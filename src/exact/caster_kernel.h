// Casts the triangles of a cluster over the cells that hold samples, and decides each sample that one may shadow.
#pragma once

#include "exact/cast_context.h"

namespace gnomon::exact {

/// Casts one cluster over the cells of all maps. From any thread.
void castCluster(const CastContext& context, std::size_t caster, CastCounts& counts);

/// The corners of triangle `triangle` of a caster, cells from the origin.
Corners cornersOf(const CastContext& context, const Caster& caster, std::size_t triangle);

/// The corners of the triangle that the sample at `place` in the grid lies on.
Corners ownCorners(const CastContext& context, std::size_t place);

/// What triangle `triangle` of `caster` does to the sample at `place` in the grid, in integers: bits of its status.
std::uint8_t decideExactly(const CastContext& context, const Caster& caster, std::size_t triangle, std::size_t place);

} // namespace gnomon::exact
