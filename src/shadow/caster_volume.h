// Caster volumes: the convex volumes that contain each caster whose shadow can fall into a region.
#pragma once

#include "core/convex_volume.h"
#include "shadow/partition/region.h"
#include "shadow/warp/warped_map.h"

namespace gnomon::shadow {

/// Returns the exact sweep of `region` towards the light. A point inside can throw a shadow into the region, and a
/// point outside cannot. Each plane touches a vertex of the region, so no smaller volume is correct.
ConvexVolume casterVolume(const Region& region, const LightFrame& frame);

/// Returns the convex hull of `corners` and the point light `light`, all in one space. It contains each caster between
/// the light and the hull of the corners. The result can be larger than the hull where corners almost coincide, but
/// never smaller.
ConvexVolume pointCasterVolume(std::span<const glm::dvec3> corners, const glm::dvec3& light);

/// Returns the volume of all casters that can change the result of a lookup for `receivers`. Receivers are all points
/// in the convex hull of the given points (camera space). The volume is their sweep towards the light. Each side is
/// moved outwards by `growS` and `growT` (fractions of the map). The far end of the map's depth range is the floor. A
/// lookup therefore reads the same depths with and without culling. The function omits a side that would move across
/// the vanishing line of the warp.
ConvexVolume grownCasterVolume(std::span<const glm::dvec3> receivers, const WarpedMap& map, double growS, double growT);

} // namespace gnomon::shadow
