// The two steps of drawing an image: the visible triangle of each pixel, then its colour. Between these steps, the
// receivers of light are known.
#pragma once

#include "render/software_pass.h"
#include "render/software_shading.h"

#include <vector>

namespace gnomon::render {

/// The buffers of an image, all of the frame's size. `words` has the format of a VisibilityTarget.
struct ImageBuffers {
    raster::Rasterizer* rasterizer = nullptr;
    SoftwarePass* pass = nullptr;
    std::vector<std::uint64_t>* words = nullptr;
    Picture* picture = nullptr;
};

/// Collects the clusters of the image in the pass and fills the words with the visible triangles. Returns the counts of
/// occlusion culling if the plan uses it. Words outside the frame's tiles stay unchanged.
std::optional<raster::OcclusionCounts> drawVisible(const DrawInputs& frame, const ImageBuffers& buffers);

/// Shades each pixel of `target` from `words` on all cores. If the target has tiles, shades only these.
void shadeVisible(const Shading& shading, std::span<const std::uint64_t> words, const ShadingTarget& target);

} // namespace gnomon::render
