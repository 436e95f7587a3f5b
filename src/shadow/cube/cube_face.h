// What the map of a point light sees through one face of the cube about it: a perspective projection from the light.
#pragma once

#include "shadow/fit/light_frame.h"
#include "shadow/partition/faces.h"

#include <array>

namespace gnomon::shadow {

/// The faces of a cube about a light whose edges lie along the world's axes, in the order of cubeFaceOf.
inline constexpr std::array kCubeFaces = {
    Face::PlusX, Face::MinusX, Face::PlusY, Face::MinusY, Face::PlusZ, Face::MinusZ};

/// The face that `offset` from the light, along the world's axes, is seen through: that of its largest component, the
/// first of these where two are as large. Shadow lookups repeat it.
std::size_t cubeFaceOf(const glm::dvec3& offset);

/// The axes of face `index` in the world: y towards the light, z and x along the map's t and s axes.
LightFrame cubeFaceAxes(std::size_t index);

/// Camera space -> (s, t, depth). With q from the light to a point and w = -q.y, the distance along the face's axis,
/// s = (q.x / w - sMin) / sRange, t = (q.z / w - tMin) / tRange, and depth = far (w - near) / ((far - near) w).
struct CubeFaceProjection {
    glm::dvec3 light{0}; // camera space
    LightFrame frame;    // likewise
    double sMin = -1;    // tangents of the angle from the axis
    double sRange = 2;
    double tMin = -1;
    double tRange = 2;
    double near = 1; // along the axis
    double far = 2;

    /// What depth changes by over a unit of w, times w squared.
    double depthSlope() const { return far * near / (far - near); }
};

/// The matrix whose product with (p, 1) is (s w, t w, depth w, w).
glm::dmat4 textureFromCamera(const CubeFaceProjection& face);

} // namespace gnomon::shadow
