// What is under the cursor: the ray through a pixel, met with what was drawn there.
#pragma once

#include "core/camera.h"
#include "executor/picture.h"

#include <optional>

namespace gnomon::viewer {

/// The world point that is drawn at a pixel (column, row from the upper left) of the picture whose view depths, seen by
/// `camera`, are given. Where nothing is, the drawn pixel nearest to it counts, within `reach` pixels, so that wires
/// and railings can be hit; nothing beyond.
std::optional<glm::dvec3> pointUnder(
    const executor::FloatPicture& viewDepth, const Camera& camera, const glm::ivec2& pixel, int reach);

} // namespace gnomon::viewer
