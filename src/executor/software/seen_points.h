// What an image shows that faces the light: where the lookups of shadow maps will be, before these are drawn.
#pragma once

#include "executor/image_pass.h"

namespace gnomon::executor {

/// Draws the image of `frame` without its shadows and answers where each pixel lies whose surface faces the light,
/// relative to the eye in the axes of the camera, in no order that means anything.
std::vector<glm::vec3> drawSeenPoints(const FrameDrawing& frame, const ImageBuffers& buffers);

} // namespace gnomon::executor
