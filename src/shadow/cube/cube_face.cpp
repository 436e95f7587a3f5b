#include "shadow/cube/cube_face.h"

#include <cmath>

namespace gnomon::shadow {

std::size_t cubeFaceOf(const glm::dvec3& offset) {
    const glm::dvec3 size = glm::abs(offset);
    const glm::length_t axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    return 2 * static_cast<std::size_t>(axis) + (offset[axis] < 0 ? 1 : 0);
}

LightFrame cubeFaceAxes(std::size_t index) {
    const auto axis = static_cast<glm::length_t>(index / 2);
    LightFrame frame{glm::dvec3(0), glm::dvec3(0), glm::dvec3(0)};
    frame.y[axis] = index % 2 == 0 ? -1 : 1; // from the face towards the light
    frame.z[(axis + 1) % 3] = 1;
    frame.x = glm::cross(frame.z, frame.y); // x is y cross z in left-handed camera space
    return frame;
}

glm::dmat4 textureFromCamera(const CubeFaceProjection& face) {
    const auto row = [&](const glm::dvec3& axis) { return glm::dvec4(axis, -glm::dot(axis, face.light)); };
    const glm::dvec4 w = row(-face.frame.y);
    const glm::dvec4 depth = (w - glm::dvec4(0, 0, 0, face.near)) * (face.far / (face.far - face.near));
    return glm::transpose(glm::dmat4(
        (row(face.frame.x) - face.sMin * w) / face.sRange,
        (row(face.frame.z) - face.tMin * w) / face.tRange,
        depth,
        w));
}

} // namespace gnomon::shadow
