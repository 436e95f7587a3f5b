// Stable slices (Blow 2004): unwarped maps of constant size, whose texel grid is fixed in the world. Shadow edges
// therefore do not crawl when the camera moves.
#pragma once

#include "core/camera.h"
#include "shadow/fit/view_frustum.h"
#include "shadow/warp/warped_map.h"

#include <array>
#include <cstdint>

namespace gnomon::shadow {

/// The position and axes of the camera in the world, which are needed to fix the texel grid of stable maps.
struct WorldAnchor {
    CameraBasis basis; // the camera's axes in world space
    glm::dvec3 eye{0}; // world space
};

/// Returns the side length of a stable map that covers `slice` in every orientation: the longest diagonal of the slice.
double stableExtent(const ViewFrustum& slice);

/// Returns the light-space axes of stable maps. They depend only on the light's direction in the world. z follows the
/// world axis with the largest angle to the light. Input and result are in camera space.
LightFrame stableFrame(const WorldAnchor& anchor, const glm::dvec3& towardsLight);

/// Returns the light-space axes of stable maps in world space. The result depends only on `towardsLight`, bit by bit.
LightFrame stableWorldFrame(const glm::dvec3& towardsLight);

/// The position of a stable map on the world's texel grid. With the same light, maps with equal places are identical,
/// independent of the camera.
struct StablePlace {
    // position of the map's corner, in texels from the world's origin: along x, away from the light, along z
    std::array<std::int64_t, 3> corner{};
    double texel = 1; // size of a texel, world units
    int texels = 1;   // texels per side
    double bias = 0;  // length by which the depth range is extended at both ends, in world units
    bool operator==(const StablePlace&) const = default;
};

/// Returns the place of the stable map that covers `slice` with `texels` (at least 2) per side, along the axes `frame`.
/// Each side has the length stableExtent * texels / (texels - 1). The extra texel permits the corner to snap to whole
/// texels of the world's grid. The depth range has the same length plus `bias` at both ends, and also snaps.
StablePlace stablePlace(
    const WorldAnchor& anchor, const LightFrame& frame, const ViewFrustum& slice, int texels, double bias);

/// Returns the projection of the stable map at `place`, along the axes `frame`. Positions are relative to `origin`,
/// which is in the world's light space, in world units.
WarpedMap stableMap(const StablePlace& place, const LightFrame& frame, const glm::dvec3& origin);

} // namespace gnomon::shadow
