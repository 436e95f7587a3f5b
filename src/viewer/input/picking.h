// Finds the scene point under the mouse cursor from the depths of the drawn image.
#pragma once

#include "core/camera.h"
#include "render/picture.h"

#include <optional>

namespace gnomon::viewer {

/// Returns the pixel nearest to `pixel` (column, row from the upper left) that shows a surface, within `reach` pixels.
/// With this tolerance the user can hit wires and railings. Returns nullopt if there is no such pixel.
std::optional<glm::ivec2> drawnPixel(const render::FloatPicture& viewDepth, const glm::ivec2& pixel, int reach);

/// Returns the world-space point that `camera` sees at `pixel`, or at the nearest pixel within `reach` that shows a
/// surface.
std::optional<glm::dvec3> pointUnder(
    const render::FloatPicture& viewDepth, const Camera& camera, const glm::ivec2& pixel, int reach);

} // namespace gnomon::viewer
