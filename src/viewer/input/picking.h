// What is under the cursor: the ray through a pixel, met with what was drawn there.
#pragma once

#include "core/camera.h"
#include "executor/picture.h"

#include <optional>

namespace gnomon::viewer {

/// A pixel (column, row from the upper left) of the picture whose view depths are given, or where nothing is drawn at
/// it the drawn one nearest to it within `reach` pixels, so that wires and railings can be hit; nothing beyond.
std::optional<glm::ivec2> drawnPixel(const executor::FloatPicture& viewDepth, const glm::ivec2& pixel, int reach);

/// The world point that is drawn there, seen by `camera`.
std::optional<glm::dvec3> pointUnder(
    const executor::FloatPicture& viewDepth, const Camera& camera, const glm::ivec2& pixel, int reach);

} // namespace gnomon::viewer
