// The image in two steps: what is visible at each pixel, then its colours. Between them it is known who receives light.
#pragma once

#include "executor/software_pass.h"
#include "executor/software_shading.h"

#include <vector>

namespace gnomon::executor {

/// Where an image is drawn; words as a VisibilityTarget's. All are there, and of the frame's size.
struct ImageBuffers {
    raster::Rasterizer* rasterizer = nullptr;
    SoftwarePass* pass = nullptr;
    std::vector<std::uint64_t>* words = nullptr;
    Picture* picture = nullptr;
    LightPicture* light = nullptr; // these two may be missing, unless the frame wants its light
    LightPicture* undecidedLight = nullptr;
};

/// Gathers the clusters of the image into the pass and fills the words: which triangle each pixel sees. Answers what
/// was left out, where the plan skips what is hidden. Where the frame is of some tiles the other words are as before.
std::optional<raster::OcclusionCounts> drawVisible(const FrameDrawing& frame, const ImageBuffers& buffers);

/// Shades every pixel of `target` by `words`, on all cores; those of its tiles, where it has some.
void shadeVisible(const Shading& shading, std::span<const std::uint64_t> words, const ShadingTarget& target);

} // namespace gnomon::executor
