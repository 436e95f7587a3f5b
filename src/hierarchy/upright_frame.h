// The axes of a model's world as someone sees them who stands on its ground.
#pragma once

#include "core/box.h"

namespace gnomon::hierarchy {

/// Right-handed and orthonormal, in world space: `front` points towards who looks at the model's front, and `right`
/// lies to the right of them. UPRIGHT space has its x, y and z along right, up and front, so a world with y up is
/// upright as it is.
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

/// The frame in which `up`, of any length above 0, is up: a turn of the world by quarters where `up` is an axis, which
/// moves no digit of a number. The front is that which the usual programs have: +z where y is up, -y where z is.
UprightFrame uprightFrame(const glm::dvec3& up);

/// The least box along upright axes that holds `box` of the world, and the other way round; empty stays empty.
Box uprightBox(const UprightFrame& frame, const Box& box);
Box worldBox(const UprightFrame& frame, const Box& box);

} // namespace gnomon::hierarchy
