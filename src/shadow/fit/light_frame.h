// The axes of light space: y towards the light, z along the t axis of the map, x along its s axis. The origin is the
// eye.
#pragma once

#include <glm/glm.hpp>

namespace gnomon::shadow {

/// The axes of light space, in camera space. `y` is the unit vector TOWARDS the light. `z` is a unit vector
/// perpendicular to y. Without lean, `x` is y cross z. With lean, the lines of constant x are oblique, like the sides
/// of a parallelogram.
struct LightFrame {
    glm::dvec3 x{1, 0, 0};
    glm::dvec3 y{0, 1, 0};
    glm::dvec3 z{0, 0, 1};
};

/// Returns the sine of the angle between the light direction and the view direction, as the length of a cross product.
/// Unlike sqrt(1 - dot^2), this form is precise for small angles.
double sinLightAngle(const glm::dvec3& towardsLight);

/// Returns the light-space axes whose z is the component of `guide` perpendicular to the light: x = normalize(L x
/// guide), z = x x L. If the light and `guide` are parallel, the result is undefined; lightFrame handles this case.
LightFrame lightFrameAlong(const glm::dvec3& towardsLight, const glm::dvec3& guide);

/// Returns the light-space axes in the plain orientation: z follows the view direction, or the camera's up direction if
/// |L x v| < 1e-12. `towardsLight` has unit length and is in camera space.
LightFrame lightFrame(const glm::dvec3& towardsLight);

/// Returns the axes `frame` rotated about the light by `radians`, from z towards x.
LightFrame rolled(const LightFrame& frame, double radians);

/// Returns the unit vector in which x increases while y and z are constant.
glm::dvec3 alongX(const LightFrame& frame);

/// Returns the axes `frame` sheared such that x is constant along the direction `side`. The z of `side` must not be 0.
LightFrame leant(const LightFrame& frame, const glm::dvec3& side);

/// Returns the shear of `frame`: the displacement of a line of constant x along alongX if z grows by 1. Perpendicular
/// axes have shear 0.
double lean(const LightFrame& frame);

/// Converts a position or direction from camera space to light space.
glm::dvec3 toLight(const LightFrame& frame, const glm::dvec3& p);

/// Converts a position or direction from light space to camera space: the inverse of toLight.
glm::dvec3 toCamera(const LightFrame& frame, const glm::dvec3& p);

} // namespace gnomon::shadow
