// Finds the scene point under the cursor from the depths of the drawn image.
#pragma once

#include "core/camera.h"
#include "render/picture.h"

#include <optional>

namespace gnomon::viewer {

/// Returns the drawn pixel at `pixel` (column, row from the upper left). If nothing is drawn there, returns the nearest
/// drawn pixel within `reach` pixels, so that the user can hit wires and railings. Returns nothing if there is no such
/// pixel.
std::optional<glm::ivec2> drawnPixel(const render::FloatPicture& viewDepth, const glm::ivec2& pixel, int reach);

/// Returns the world point that `camera` sees at this pixel.
std::optional<glm::dvec3> pointUnder(
    const render::FloatPicture& viewDepth, const Camera& camera, const glm::ivec2& pixel, int reach);

} // namespace gnomon::viewer
