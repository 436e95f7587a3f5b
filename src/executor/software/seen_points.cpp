#include "executor/software/seen_points.h"

#include "executor/frame_block.h"

namespace gnomon::executor {

std::vector<glm::vec3> drawSeenPoints(const FrameDrawing& frame, const ImageBuffers& buffers) {
    drawVisible(frame, buffers);
    std::vector<glm::vec4> facing(buffers.picture->pixels.size(), glm::vec4(0));
    const FloatPicture noMaps;
    plan::FramePlan unlit = *frame.plan;
    unlit.passes.clear();
    FrameDrawing withoutMaps = frame;
    withoutMaps.plan = &unlit;
    const Shading shading(withoutMaps, imageClipFromDraw(frame), noMaps, buffers.pass->drawn());
    ShadingTarget target;
    target.picture = buffers.picture;
    target.facing = &facing;
    shadeVisible(shading, *buffers.words, target);
    std::vector<glm::vec3> points;
    for (const glm::vec4& point : facing)
        if (point.w > 0) points.emplace_back(frame.space.cameraFromDraw * glm::dvec4(glm::vec3(point), 1));
    return points;
}

} // namespace gnomon::executor
