#include "render/view/image_projection.h"

#include "render/backend.h"

#include <cmath>

namespace gnomon::render {

glm::dmat4 ImageProjection::clipFromCamera(const glm::dvec2& moved) const {
    const glm::dvec4 x(1 / half.x, 0, depth.isParallel ? 0 : moved.x, depth.isParallel ? moved.x : 0);
    const glm::dvec4 y(0, 1 / half.y, depth.isParallel ? 0 : moved.y, depth.isParallel ? moved.y : 0);
    if (!depth.isParallel) return glm::transpose(glm::dmat4(x, y, {0, 0, 0, depth.clip.near}, {0, 0, 1, 0}));
    const double perDepth = 1 / (depth.clip.far - depth.clip.near);
    return glm::transpose(glm::dmat4(x, y, {0, 0, -perDepth, depth.clip.far * perDepth}, {0, 0, 0, 1}));
}

glm::dvec3 ImageProjection::visiblePoint(const glm::dvec2& point, double depthFromEye) const {
    const glm::dvec2 across = point * half;
    return {depth.isParallel ? across : across * depthFromEye, depthFromEye};
}

ImageProjection imageProjection(const DrawInputs& frame) {
    const plan::View& view = frame.plan->view;
    const Camera camera = frame.observerCamera.value_or(view.camera);
    ImageProjection projection;
    projection.basis = cameraBasis(camera);
    projection.eye = frame.space.eye + (camera.eye - view.camera.eye);
    const double halfHeight = camera.isParallel() ? halfHeightAtTarget(camera) : std::tan(camera.fovYRadians / 2);
    projection.half = {view.aspect() * halfHeight, halfHeight};
    projection.depth = {camera.isParallel(), {frame.clipNear, frame.clipFar}, 0};
    if (!frame.observerCamera) projection.depth.eyeMovedBack = view.eyeMovedBack.value_or(0);
    return projection;
}

} // namespace gnomon::render
