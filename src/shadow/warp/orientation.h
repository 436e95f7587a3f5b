// Chooses the rotation of a shadow map about the light direction. In the plain orientation (lightFrame), the map spins
// when the light becomes almost parallel to the view. The chosen rotation minimises the storage factor and has a
// limited angular speed.
#pragma once

#include "shadow/fit/light_fit.h"
#include "shadow/warp/warp.h"

#include <optional>

namespace gnomon::shadow {

/// The orientation of a shadow map in the previous frame: the light direction and the t axis of the map, both in camera
/// space.
struct OrientationState {
    glm::dvec3 towardsLight{0, 1, 0};
    glm::dvec3 zAxis{0, 0, 1};
};

/// Max rotation of the map between two frames, in radians per radian of light movement in camera space. The rotation by
/// `carried` does not count. If the light moves by more than 6 degrees, any orientation is permitted.
constexpr double kOrientationRate = 30;

/// Returns the t axis of the previous frame's map, rotated with the light: by the smallest rotation that moves the
/// previous light direction to `towardsLight`.
glm::dvec3 carried(const OrientationState& state, const glm::dvec3& towardsLight);

/// Returns the light-space axes for the shadow map of `slice` whose rotation about the light minimises the storage
/// factor S for `warp`. S is never larger than in the plain orientation. With a previous state, the rotation follows
/// its current local minimum of S until another minimum is 5% lower. The rotation changes by at most kOrientationRate.
/// Where the warp vanishes, the map becomes aligned with the camera, because S is then smallest.
LightFrame chosenFrame(
    const ViewFrustum& slice,
    const glm::dvec3& towardsLight,
    const Warp& warp,
    const std::optional<OrientationState>& previous);

} // namespace gnomon::shadow
