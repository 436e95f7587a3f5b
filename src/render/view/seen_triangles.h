// Finds the triangle of the model that each pixel of a visibility buffer shows.
#pragma once

#include "render/backend.h"
#include "render/view/drawn_cluster.h"

#include <array>
#include <cstdint>
#include <span>

namespace gnomon::render {

/// Returns the visible triangle of each pixel, with rows from top to bottom. The image has `width` x `height` pixels.
/// `words` is its visibility buffer, with rows from bottom to top. Triangle ids in `words` refer to the clusters in
/// `drawn`.
Raster<SeenTriangle> seenTriangles(
    int width, int height, std::span<const std::uint64_t> words, std::span<const DrawnCluster> drawn);

} // namespace gnomon::render
