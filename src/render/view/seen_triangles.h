// The visible triangle of the model per pixel of a visibility buffer.
#pragma once

#include "render/backend.h"
#include "render/view/drawn_cluster.h"

#include <array>
#include <cstdint>
#include <span>

namespace gnomon::render {

/// Of an image of `width` by `height` pixels whose visibility buffer, rows from bottom to top, names triangles of
/// `drawn`. Rows of the result go from top to bottom.
Raster<SeenTriangle> seenTriangles(
    int width, int height, std::span<const std::uint64_t> words, std::span<const DrawnCluster> drawn);

} // namespace gnomon::render
