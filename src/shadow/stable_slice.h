// Stable slices (Blow 2004): an unwarped map whose size does not depend on how the camera is turned and whose texels
// lie on a grid fixed in the world, so that shadow edges do not crawl as the camera moves.
#pragma once

#include "core/camera.h"
#include "shadow/view_frustum.h"
#include "shadow/warped_map.h"

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

/// The map of `slice` with `texels` (at least 2) a side in `frame`: each side is stableExtent * texels / (texels - 1)
/// long, a texel of margin, so that its corner can snap to whole texels of the world's grid and the slice still fits.
/// The depth range is as long plus `bias` at both ends, and snaps alike.
WarpedMap stableMap(
    const WorldAnchor& anchor, const LightFrame& frame, const ViewFrustum& slice, int texels, double bias);

} // namespace gnomon::shadow
