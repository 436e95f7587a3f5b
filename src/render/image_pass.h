// The two steps of drawing an image: first the visible triangle of each pixel, then its colour. Shadows can be computed
// between these steps, because the visible points are then known.
#pragma once

#include "render/software_pass.h"
#include "render/software_shading.h"

#include <vector>

namespace gnomon::render {

/// The buffers for drawing an image, all of the size of the frame. `words` is a visibility buffer in the format of
/// VisibilityTarget.
struct ImageBuffers {
    raster::Rasterizer* rasterizer = nullptr;
    SoftwarePass* pass = nullptr;
    std::vector<std::uint64_t>* words = nullptr;
    Picture* picture = nullptr;
};

/// Collects the clusters of the image in the pass, and fills `words` with the visible triangles. If the plan uses
/// occlusion culling, returns its counts. Words outside the tiles of the frame stay unchanged.
std::optional<raster::OcclusionCounts> drawVisible(const DrawInputs& frame, const ImageBuffers& buffers);

/// Shades each pixel of `target` on all cores. `words` is the visibility buffer. If the target has tiles, shades only
/// these tiles.
void shadeVisible(const Shading& shading, std::span<const std::uint64_t> words, const ShadingTarget& target);

} // namespace gnomon::render
