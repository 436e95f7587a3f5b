// The rotation of a shadow map about the light direction. With the plain convention (lightFrame), the map spins when
// the light becomes parallel to the view. The rotation here minimises the storage factor and limits the angular speed.
#pragma once

#include "shadow/fit/light_fit.h"
#include "shadow/warp/warp.h"

#include <optional>

namespace gnomon::shadow {

/// The state from the previous frame: the light direction and the t axis of the map, both in camera space.
struct OrientationState {
    glm::dvec3 towardsLight{0, 1, 0};
    glm::dvec3 zAxis{0, 0, 1};
};

/// Max rotation of the map, in radians per radian of light movement in camera space. The rotation that `carried`
/// applies is not counted. A light movement of more than 6 degrees therefore permits any orientation.
constexpr double kOrientationRate = 30;

/// Returns the axis of `state`, turned by the smallest rotation that maps its light direction to `towardsLight`.
glm::dvec3 carried(const OrientationState& state, const glm::dvec3& towardsLight);

/// Returns the frame for `slice` and `warp` whose rotation about the light minimises the storage factor S. S is never
/// larger than in the plain orientation. With a previous state, the rotation follows its current local minimum of S
/// until another minimum is 5% lower, and turns by at most kOrientationRate. When the warp disappears, the frame
/// becomes aligned with the camera, because S is then smallest.
LightFrame chosenFrame(
    const ViewFrustum& slice,
    const glm::dvec3& towardsLight,
    const Warp& warp,
    const std::optional<OrientationState>& previous);

} // namespace gnomon::shadow
