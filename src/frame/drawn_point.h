// The point of the model that a pixel shows, computed from the triangle in the pixel. This is more precise than a point
// from the depth buffer.
#pragma once

#include "frame/renderer.h"

#include <optional>

namespace gnomon::frame {

/// A point on the model's grid, and its max distance to the surface of the source in world units.
struct GridPlace {
    glm::i64vec3 cell{0};
    double within = 0;
};

struct DrawnPoint {
    GridPlace point;                 // the visible point, rounded to the grid
    std::optional<GridPlace> vertex; // the nearest vertex of the triangle; empty on the cap of a section
};

/// Returns the first point of the drawn geometry on the line of sight through the centre of a pixel. The point is on a
/// triangle or on the cap of a section, rounded to the grid. `pixel` is column and row from the upper left. `frame`
/// must be the last frame of `renderer`, drawn with `options`. Returns nullopt if the pixel shows no point of the
/// model, or if the pages of this point have been evicted.
std::optional<DrawnPoint> drawnPoint(
    const Renderer& renderer, const PreparedFrame& frame, const FrameOptions& options, const glm::ivec2& pixel);

} // namespace gnomon::frame
