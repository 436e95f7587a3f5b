// Finds the point of the model that a pixel shows. The point is computed from the triangle in the pixel, which is more
// precise than the depth buffer.
#pragma once

#include "frame/renderer.h"

#include <optional>

namespace gnomon::frame {

/// A point on the model's grid, and its max distance to the surface of the source mesh in world units.
struct GridPlace {
    glm::i64vec3 cell{0};
    double within = 0;
};

struct DrawnPoint {
    GridPlace point;                 // visible point, rounded to the model's integer grid
    std::optional<GridPlace> vertex; // the nearest vertex of the triangle; empty on the cap of a section
};

/// Returns the first point of the drawn geometry on the line of sight through the centre of a pixel. The point is on a
/// triangle or on the cap of a section plane, and is rounded to the model's grid. `pixel` is column and row from the
/// upper left. `frame` must be the last frame of `renderer`, drawn with `options`. Returns nullopt if the pixel shows
/// no point of the model, or if the data of this point have been evicted from memory.
std::optional<DrawnPoint> drawnPoint(
    const Renderer& renderer, const PreparedFrame& frame, const FrameOptions& options, const glm::ivec2& pixel);

} // namespace gnomon::frame
