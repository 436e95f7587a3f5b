// Draws an image in two steps: first the visible triangle of each pixel, then its colour. The shadows of the visible
// points can be computed between these steps.
#pragma once

#include "render/software_pass.h"
#include "render/software_shading.h"

#include <vector>

namespace gnomon::render {

/// The buffers for drawing an image, all of the size of the frame. `words` is a visibility buffer (see
/// VisibilityTarget).
struct ImageBuffers {
    raster::Rasterizer* rasterizer = nullptr;
    SoftwarePass* pass = nullptr;
    std::vector<std::uint64_t>* words = nullptr;
    Picture* picture = nullptr;
};

/// Draws the visible triangle of each pixel into `words`. If the plan uses occlusion culling, returns the numbers of
/// skipped clusters and triangles. Pixels outside the tiles of the frame stay unchanged.
std::optional<raster::OcclusionCounts> drawVisible(const DrawInputs& frame, const ImageBuffers& buffers);

/// Shades the pixels of `target` on all cores. `words` is the visibility buffer. If the target has tiles, only these
/// tiles are shaded.
void shadeVisible(const Shading& shading, std::span<const std::uint64_t> words, const ShadingTarget& target);

} // namespace gnomon::render
