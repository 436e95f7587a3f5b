// The axes right, up and front of a model, for an observer who stands upright in its world.
#pragma once

#include "core/box.h"

namespace gnomon::hierarchy {

/// The axes right, up and front of a model in world space, right-handed and orthonormal. `front` points from the
/// model's front to an observer before it. `right` points to the right of this observer. UPRIGHT space has its x, y and
/// z axes along right, up and front. If y is up, world space and upright space are identical.
struct UprightFrame {
    glm::dvec3 right{1, 0, 0};
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 front{0, 0, 1};

    glm::dvec3 toWorld(const glm::dvec3& upright) const {
        return right * upright.x + up * upright.y + front * upright.z;
    }

    glm::dvec3 toUpright(const glm::dvec3& world) const {
        return {glm::dot(world, right), glm::dot(world, up), glm::dot(world, front)};
    }
};

/// Returns the axes for the up direction `up`, which can have any length greater than 0. If `up` is an axis, the frame
/// is a rotation by multiples of 90 degrees, so coordinates stay exact. The front follows common modelling programs: it
/// is +z if y is up, and -y if z is up.
UprightFrame uprightFrame(const glm::dvec3& up);

/// The following functions transform `box` to upright space or to world space. They return the smallest axis-aligned
/// box around the result. An empty box stays empty.
Box uprightBox(const UprightFrame& frame, const Box& box);
Box worldBox(const UprightFrame& frame, const Box& box);

} // namespace gnomon::hierarchy
