// Stable slices (Blow 2004): an unwarped map whose size does not depend on how the camera is turned and whose texels
// lie on a grid fixed in the world, so that shadow edges do not crawl as the camera moves.
#pragma once

#include "core/camera.h"
#include "shadow/fit/view_frustum.h"
#include "shadow/warp/warped_map.h"

#include <array>
#include <cstdint>

namespace gnomon::shadow {

/// Where the grid of stable maps is anchored.
struct WorldAnchor {
    CameraBasis basis; // the camera's axes in world space
    glm::dvec3 eye{0}; // world space
};

/// The extent that a stable map of `slice` has to have in any orientation: the longest of its diagonals.
double stableExtent(const ViewFrustum& slice);

/// The frame that depends on nothing but the light's direction in the world: z along the world axis furthest from it.
/// Given and returned in camera space.
LightFrame stableFrame(const WorldAnchor& anchor, const glm::dvec3& towardsLight);

/// The same in world space, where it depends on nothing else to the last bit.
LightFrame stableWorldFrame(const glm::dvec3& towardsLight);

/// Where a stable map lies on the world's grid. Under one light, maps of equal places are one map, wherever they are
/// seen from.
struct StablePlace {
    std::array<std::int64_t, 3> corner{}; // in texels along x, away from the light and along z, from the world's origin
    double texel = 1;                     // world units
    int texels = 1;                       // a side
    double bias = 0;                      // by which the depth range is longer at both ends
    bool operator==(const StablePlace&) const = default;
};

/// The place of the map of `slice` with `texels` (at least 2) a side in `frame`: each side is
/// stableExtent * texels / (texels - 1) long, a texel of margin, so that its corner can snap to whole texels of the
/// world's grid and the slice still fits. The depth range is as long plus `bias` at both ends, and snaps alike.
StablePlace stablePlace(
    const WorldAnchor& anchor, const LightFrame& frame, const ViewFrustum& slice, int texels, double bias);

/// The map at `place` for positions relative to `origin` (light space of the world, world units), in the axes that
/// `frame` is given in.
WarpedMap stableMap(const StablePlace& place, const LightFrame& frame, const glm::dvec3& origin);

} // namespace gnomon::shadow
