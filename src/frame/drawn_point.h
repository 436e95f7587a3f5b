// What a frame drew at a place of its image: the point of a triangle, from the triangle itself and not from depths.
#pragma once

#include "frame/renderer.h"

#include <optional>

namespace gnomon::frame {

/// A point in steps of the model's grid, and how far at most it is from the source's surface, world units.
struct GridPlace {
    glm::i64vec3 cell{0};
    double within = 0;
};

struct DrawnPoint {
    GridPlace point;                 // rounded to the grid
    std::optional<GridPlace> vertex; // the triangle's nearest; nothing on the cap of a section
};

/// The first point of what is drawn on the line of sight through the middle of a pixel, column and row from the upper
/// left, of `frame`, which is the last that `renderer` drew, with these `options`: on the triangle but for the rounding
/// to the grid, or on a section's cap. Nothing where nothing of the model is seen, or where its pages have gone since.
std::optional<DrawnPoint> drawnPoint(
    const Renderer& renderer, const PreparedFrame& frame, const FrameOptions& options, const glm::ivec2& pixel);

} // namespace gnomon::frame
