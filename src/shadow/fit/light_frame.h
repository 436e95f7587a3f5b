// The axes of light space: y towards the light, z along the map's t axis, x along its s axis, all through the eye.
#pragma once

#include <glm/glm.hpp>

namespace gnomon::shadow {

/// A frame in camera space. `y` is the unit vector TOWARDS the light, z is across it and of unit length, and x is
/// y cross z unless the frame leans: then lines of equal x lie obliquely, as the sides of a parallelogram.
struct LightFrame {
    glm::dvec3 x{1, 0, 0};
    glm::dvec3 y{0, 1, 0};
    glm::dvec3 z{0, 0, 1};
};

/// The sine of the angle between the light and the view, as the length of a cross product: exact to the last digits
/// where sqrt(1 - dot^2) has none left.
double sinLightAngle(const glm::dvec3& towardsLight);

/// The frame whose z is `guide` made perpendicular to the light: x = normalize(L x guide), z = x x L. Nothing is
/// guaranteed where the two are parallel; see lightFrame.
LightFrame lightFrameAlong(const glm::dvec3& towardsLight, const glm::dvec3& guide);

/// The plain convention: z follows the view direction; camera up stands in for it where |L x v| < 1e-12.
/// `towardsLight` has unit length, in camera space.
LightFrame lightFrame(const glm::dvec3& towardsLight);

/// `frame` rolled about the light by `radians`, from z towards x.
LightFrame rolled(const LightFrame& frame, double radians);

/// The unit vector along which x grows while y and z stay.
glm::dvec3 alongX(const LightFrame& frame);

/// `frame` leant so that x stays along `side`, whose z is not 0.
LightFrame leant(const LightFrame& frame, const glm::dvec3& side);

/// How far a line of equal x moves along alongX while z grows by 1; 0 unless the frame leans.
double lean(const LightFrame& frame);

/// A position or direction of camera space in light space.
glm::dvec3 toLight(const LightFrame& frame, const glm::dvec3& p);

/// The inverse of toLight.
glm::dvec3 toCamera(const LightFrame& frame, const glm::dvec3& p);

} // namespace gnomon::shadow
