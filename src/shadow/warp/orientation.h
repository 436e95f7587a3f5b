// The roll of a map about the light (lightRoll). The plain convention spins as the light turns parallel to the view;
// this one is chosen for the least storage and follows the light no faster than the eye forgives.
#pragma once

#include "shadow/fit/light_fit.h"
#include "shadow/warp/warp.h"

#include <optional>

namespace gnomon::shadow {

/// What the choice remembers from frame to frame: the light and the map's t axis, both in camera space.
struct OrientationState {
    glm::dvec3 towardsLight{0, 1, 0};
    glm::dvec3 zAxis{0, 0, 1};
};

/// How far the orientation may roll for each radian that the light moves in camera space, beyond what carrying it along
/// takes. Light movements of more than about 6 degrees therefore choose afresh.
constexpr double kOrientationRate = 30;

/// The axis of `state` carried along by the least rotation that takes its light to `towardsLight`.
glm::dvec3 carried(const OrientationState& state, const glm::dvec3& towardsLight);

/// The frame for `slice` and `warp`: the light roll of the least S, never more than in the plain orientation.
/// With a previous state it stays at the local minimum of S that it is at until another is 5% lower, and moves no
/// faster than kOrientationRate. As the warp fades it is aligned with the camera, since that is where S then is least.
LightFrame chosenFrame(
    const ViewFrustum& slice,
    const glm::dvec3& towardsLight,
    const Warp& warp,
    const std::optional<OrientationState>& previous);

} // namespace gnomon::shadow
