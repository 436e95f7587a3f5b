// Which triangle of the model each pixel of a visibility buffer shows.
#pragma once

#include "executor/picture.h"
#include "executor/view/drawn_cluster.h"

#include <array>
#include <cstdint>
#include <span>

namespace gnomon::executor {

/// The triangle of the model that a pixel shows.
struct SeenTriangle {
    std::uint32_t page = hierarchy::kNone; // kNone where none is seen: the background, the ground, a section's cap
    std::uint32_t cluster = 0;             // in the page, as are:
    std::array<std::uint32_t, 3> vertices{};
};

/// Of an image of `width` by `height` pixels whose visibility buffer, rows from bottom to top, names triangles of
/// `drawn`. Rows of the result go from top to bottom.
Raster<SeenTriangle> seenTriangles(
    int width, int height, std::span<const std::uint64_t> words, std::span<const DrawnCluster> drawn);

} // namespace gnomon::executor
