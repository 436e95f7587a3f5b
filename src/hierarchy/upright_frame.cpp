#include "hierarchy/upright_frame.h"

#include <cmath>

namespace gnomon::hierarchy {

UprightFrame uprightFrame(const glm::dvec3& up) {
    UprightFrame frame;
    frame.up = up / glm::length(up);
    // z is the front of all but what has it up or nearly so.
    const bool isAlongZ = std::abs(up.z) > std::abs(up.y) && std::abs(up.z) > std::abs(up.x);
    const glm::dvec3 ahead = isAlongZ ? glm::dvec3(0, up.z > 0 ? -1 : 1, 0) : glm::dvec3(0, 0, 1);
    frame.front = glm::normalize(ahead - frame.up * glm::dot(ahead, frame.up));
    frame.right = glm::cross(frame.up, frame.front);
    return frame;
}

} // namespace gnomon::hierarchy
