#include "render/view/lens.h"

#include "render/backend.h"

#include <cmath>

namespace gnomon::render {

glm::dmat4 Lens::clipFromCamera(const glm::dvec2& moved) const {
    const glm::dvec4 x(1 / half.x, 0, depth.isParallel ? 0 : moved.x, depth.isParallel ? moved.x : 0);
    const glm::dvec4 y(0, 1 / half.y, depth.isParallel ? 0 : moved.y, depth.isParallel ? moved.y : 0);
    if (!depth.isParallel) return glm::transpose(glm::dmat4(x, y, {0, 0, 0, depth.clip.near}, {0, 0, 1, 0}));
    const double perDepth = 1 / (depth.clip.far - depth.clip.near);
    return glm::transpose(glm::dmat4(x, y, {0, 0, -perDepth, depth.clip.far * perDepth}, {0, 0, 0, 1}));
}

glm::dvec3 Lens::seenAt(const glm::dvec2& point, double depthFromEye) const {
    const glm::dvec2 across = point * half;
    return {depth.isParallel ? across : across * depthFromEye, depthFromEye};
}

Lens lensOf(const FrameDrawing& frame) {
    const plan::View& view = frame.plan->view;
    const Camera camera = frame.observerCamera.value_or(view.camera);
    Lens lens;
    lens.basis = cameraBasis(camera);
    lens.eye = frame.space.eye + (camera.eye - view.camera.eye);
    const double halfHeight = camera.isParallel() ? halfHeightAtTarget(camera) : std::tan(camera.fovYRadians / 2);
    lens.half = {view.aspect() * halfHeight, halfHeight};
    lens.depth = {camera.isParallel(), {frame.clipNear, frame.clipFar}, 0};
    if (!frame.observerCamera) lens.depth.eyeMovedBack = view.eyeMovedBack.value_or(0);
    return lens;
}

} // namespace gnomon::render
