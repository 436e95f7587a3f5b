#include "core/camera.h"

#include "core/error.h"

#include <cmath>

namespace gnomon {

namespace {

bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

CameraBasis cameraBasis(const Camera& camera) {
    if (!isFinite(camera.eye) || !isFinite(camera.target) || !isFinite(camera.up))
        throw Error("camera", "eye, target and up must be finite numbers");
    const glm::dvec3 toTarget = camera.target - camera.eye;
    const double length = glm::length(toTarget);
    if (!(length > 0)) throw Error("camera", "eye and target are the same point");
    CameraBasis basis;
    basis.view = toTarget / length;
    glm::dvec3 side = glm::cross(basis.view, camera.up);
    if (!(glm::length(side) > 1e-9 * glm::length(camera.up))) {
        const glm::dvec3 a = glm::abs(basis.view);
        const bool isXMin = a.x <= a.y && a.x <= a.z;
        const glm::dvec3 axis = isXMin ? glm::dvec3(1, 0, 0) : a.y <= a.z ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
        side = glm::cross(basis.view, axis);
    }
    basis.right = glm::normalize(side);
    basis.up = glm::cross(basis.right, basis.view);
    return basis;
}

double halfHeightAtTarget(const Camera& camera) {
    return glm::length(camera.target - camera.eye) * std::tan(camera.fovYRadians / 2);
}

glm::dvec3 toCamera(const CameraBasis& basis, const glm::dvec3& vector) {
    return {glm::dot(vector, basis.right), glm::dot(vector, basis.up), glm::dot(vector, basis.view)};
}

glm::dvec3 toWorld(const CameraBasis& basis, const glm::dvec3& vector) {
    return basis.right * vector.x + basis.up * vector.y + basis.view * vector.z;
}

} // namespace gnomon
