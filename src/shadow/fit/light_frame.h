// The axes of light space: y towards the light, z along the t axis of the map, x along its s axis. The origin is the
// eye.
#pragma once

#include <glm/glm.hpp>

namespace gnomon::shadow {

/// The axes of light space, in camera space. `y` is the unit vector TOWARDS the light. `z` has unit length and is
/// perpendicular to y. `x` is y cross z in a frame without lean. In a frame with lean, the lines of constant x are
/// oblique, like the sides of a parallelogram.
struct LightFrame {
    glm::dvec3 x{1, 0, 0};
    glm::dvec3 y{0, 1, 0};
    glm::dvec3 z{0, 0, 1};
};

/// Returns the sine of the angle between light and view, as the length of a cross product. This form is exact for small
/// angles, where sqrt(1 - dot^2) loses all digits.
double sinLightAngle(const glm::dvec3& towardsLight);

/// Returns the frame whose z is `guide` made perpendicular to the light: x = normalize(L x guide), z = x x L. The
/// result is undefined if the light and `guide` are parallel; lightFrame handles that case.
LightFrame lightFrameAlong(const glm::dvec3& towardsLight, const glm::dvec3& guide);

/// Returns the frame of the plain convention: z follows the view direction, or the camera's up direction if |L x v| <
/// 1e-12. `towardsLight` has unit length and is in camera space.
LightFrame lightFrame(const glm::dvec3& towardsLight);

/// Returns `frame` rotated about the light by `radians`, from z towards x.
LightFrame rolled(const LightFrame& frame, double radians);

/// Returns the unit vector of increasing x at constant y and z.
glm::dvec3 alongX(const LightFrame& frame);

/// Returns `frame` with a lean such that x is constant along `side`. The z of `side` must not be 0.
LightFrame leant(const LightFrame& frame, const glm::dvec3& side);

/// Returns the lean: the distance along alongX that a line of constant x moves while z grows by 1. It is 0 in a frame
/// without lean.
double lean(const LightFrame& frame);

/// Converts a position or direction from camera space to light space.
glm::dvec3 toLight(const LightFrame& frame, const glm::dvec3& p);

/// Converts a position or direction from light space to camera space: the inverse of toLight.
glm::dvec3 toCamera(const LightFrame& frame, const glm::dvec3& p);

} // namespace gnomon::shadow
