// The perspective projection of a point light through one face of the cube around the light.
#pragma once

#include "shadow/fit/light_frame.h"
#include "shadow/partition/faces.h"

#include <array>

namespace gnomon::shadow {

/// The faces of the cube around a point light, in the order of cubeFaceOf. The edges of the cube are parallel to the
/// world axes.
inline constexpr std::array kCubeFaces = {
    Face::PlusX, Face::MinusX, Face::PlusY, Face::MinusY, Face::PlusZ, Face::MinusZ};

/// Returns the index of the cube face that contains the direction `offset` from the light, in world axes. The largest
/// component selects the face. If components are equal, the first component is used. The shaders use the same rule for
/// shadow lookups.
std::size_t cubeFaceOf(const glm::dvec3& offset);

/// Returns the axes of the map of cube face `index`, in world space: y towards the light, z along the t axis of the
/// map, x along its s axis.
LightFrame cubeFaceAxes(std::size_t index);

/// The projection from camera space to (s, t, depth). Let q be the vector from the light to a point, and w = -q.y the
/// distance along the face's axis. Then s = (q.x / w - sMin) / sRange, t = (q.z / w - tMin) / tRange, and depth = far
/// (w - near) / ((far - near) w).
struct CubeFaceProjection {
    glm::dvec3 light{0}; // camera space
    LightFrame frame;    // camera space
    double sMin = -1;    // tangents of the angle to the axis of the face
    double sRange = 2;
    double tMin = -1;
    double tRange = 2;
    double near = 1; // distance along the axis of the face
    double far = 2;

    /// Returns the derivative of the map's depth by w (distance along the face's axis), multiplied by w^2.
    double depthSlope() const { return far * near / (far - near); }
};

/// Returns the projection of `face` as a matrix. Its product with (p, 1) is (s w, t w, depth w, w).
glm::dmat4 textureFromCamera(const CubeFaceProjection& face);

} // namespace gnomon::shadow
