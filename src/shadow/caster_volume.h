// Caster volumes: all that can throw a shadow into a region, as the planes of the region swept towards the light.
#pragma once

#include "core/convex_volume.h"
#include "shadow/partition/region.h"
#include "shadow/warp/warped_map.h"

namespace gnomon::shadow {

/// The exact sweep of `region` towards the light: a point outside shadows nothing in the region, a point inside does.
/// Every plane touches a vertex of the region, so none can be moved in.
ConvexVolume casterVolume(const Region& region, const LightFrame& frame);

/// The convex hull of `corners` and `light`, in any one space: all that can stand between a point within these and a
/// point light. May be larger where corners nearly coincide, never smaller.
ConvexVolume pointCasterVolume(std::span<const glm::dvec3> corners, const glm::dvec3& light);

/// All that can change what a lookup within the convex hull of `receivers` (camera space) reads: its sweep, with each
/// side moved out by `growS` and `growT` (fractions of the map) through the map itself, and with the map's far end of
/// depth as floor, so that depth that a lookup can read is the same with and without culling. A side that the growth
/// carries past the warp's vanishing line bounds nothing and is left out.
ConvexVolume grownCasterVolume(std::span<const glm::dvec3> receivers, const WarpedMap& map, double growS, double growT);

} // namespace gnomon::shadow
