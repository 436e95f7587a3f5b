#include "hierarchy/upright_frame.h"

#include <cmath>

namespace gnomon::hierarchy {

namespace {

/// Returns the smallest axis-aligned box that contains the corners of `box` after the transformation `turn`.
template <class Turn>
Box turnedBox(const Box& box, const Turn& turn) {
    Box turned;
    if (box.isEmpty()) return turned;
    for (int corner = 0; corner < 8; ++corner)
        turned.add(turn(glm::dvec3(
            (corner & 1) != 0 ? box.max.x : box.min.x,
            (corner & 2) != 0 ? box.max.y : box.min.y,
            (corner & 4) != 0 ? box.max.z : box.min.z)));
    return turned;
}

} // namespace

Box uprightBox(const UprightFrame& frame, const Box& box) {
    return turnedBox(box, [&](const glm::dvec3& corner) { return frame.toUpright(corner); });
}

Box worldBox(const UprightFrame& frame, const Box& box) {
    return turnedBox(box, [&](const glm::dvec3& corner) { return frame.toWorld(corner); });
}

UprightFrame uprightFrame(const glm::dvec3& up) {
    UprightFrame frame;
    frame.up = up / glm::length(up);
    // The front of the model is along z, unless z is the axis nearest to the up direction.
    const bool isAlongZ = std::abs(up.z) > std::abs(up.y) && std::abs(up.z) > std::abs(up.x);
    const glm::dvec3 ahead = isAlongZ ? glm::dvec3(0, up.z > 0 ? -1 : 1, 0) : glm::dvec3(0, 0, 1);
    frame.front = glm::normalize(ahead - frame.up * glm::dot(ahead, frame.up));
    frame.right = glm::cross(frame.up, frame.front);
    return frame;
}

} // namespace gnomon::hierarchy
