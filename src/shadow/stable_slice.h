// Stable slices (Blow 2004): unwarped maps of constant size whose texels lie on a grid fixed in the world. Shadow edges
// therefore do not crawl when the camera moves.
#pragma once

#include "core/camera.h"
#include "shadow/fit/view_frustum.h"
#include "shadow/warp/warped_map.h"

#include <array>
#include <cstdint>

namespace gnomon::shadow {

/// The camera's position and axes in the world, which fix the texel grid of stable maps.
struct WorldAnchor {
    CameraBasis basis; // the camera's axes in world space
    glm::dvec3 eye{0}; // world space
};

/// Returns the side of a stable map for `slice` that suffices in each orientation: the longest diagonal of the slice.
double stableExtent(const ViewFrustum& slice);

/// Returns a frame that depends only on the light's direction in the world. z follows the world axis with the largest
/// angle to the light. Input and result are in camera space.
LightFrame stableFrame(const WorldAnchor& anchor, const glm::dvec3& towardsLight);

/// Returns the same frame in world space. The result depends only on `towardsLight`, to the last bit.
LightFrame stableWorldFrame(const glm::dvec3& towardsLight);

/// The position of a stable map on the world's texel grid. With the same light, maps with equal places are identical,
/// independent of the camera.
struct StablePlace {
    std::array<std::int64_t, 3> corner{}; // in texels from the world's origin: along x, away from the light, along z
    double texel = 1;                     // size of a texel, world units
    int texels = 1;                       // texels per side
    double bias = 0;                      // length that the depth range adds at both ends
    bool operator==(const StablePlace&) const = default;
};

/// Returns the place of the map of `slice` with `texels` (at least 2) per side in `frame`. Each side has the length
/// stableExtent * texels / (texels - 1). The extra texel lets the corner snap to whole texels of the world's grid. The
/// depth range has the same length plus `bias` at both ends, and also snaps.
StablePlace stablePlace(
    const WorldAnchor& anchor, const LightFrame& frame, const ViewFrustum& slice, int texels, double bias);

/// Returns the map at `place`, in the axes of `frame`, for positions relative to `origin` (light space of the world,
/// world units).
WarpedMap stableMap(const StablePlace& place, const LightFrame& frame, const glm::dvec3& origin);

} // namespace gnomon::shadow
