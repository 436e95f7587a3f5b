// Computes caster volumes: convex volumes that contain each caster whose shadow can fall into a region.
#pragma once

#include "core/convex_volume.h"
#include "shadow/partition/region.h"
#include "shadow/warp/warped_map.h"

namespace gnomon::shadow {

/// Returns the volume of all casters whose shadow can fall into `region`: the region swept towards the light. A point
/// inside this volume can throw a shadow into the region, and a point outside cannot. Each plane touches a vertex of
/// the region, so no smaller volume is correct.
ConvexVolume casterVolume(const Region& region, const LightFrame& frame);

/// Returns the convex hull of `corners` and of the point light `light`, all in one space. The hull contains all casters
/// between the light and the convex hull of `corners`. If some corners almost coincide, the result can be larger than
/// the hull, but never smaller.
ConvexVolume pointCasterVolume(std::span<const glm::dvec3> corners, const glm::dvec3& light);

/// Returns the volume of all casters that can change the result of a lookup in `map` for a receiver. A receiver is any
/// point in the convex hull of `receivers` (camera space). The volume is the sweep of this hull towards the light. Each
/// side is moved outwards by `growS` and `growT`, as fractions of the map, for the reach of the filter. The floor of
/// the volume is the far end of the map's depth range. A lookup therefore reads the same depths with and without
/// culling. If a side would move across the vanishing line of the warp, the function omits this side.
ConvexVolume grownCasterVolume(std::span<const glm::dvec3> receivers, const WarpedMap& map, double growS, double growT);

} // namespace gnomon::shadow
