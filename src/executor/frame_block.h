// Filling the blocks that the shaders read from a frame: the one place where doubles become floats.
#pragma once

#include "executor/executor.h"
#include "shaders/shared/frame_block.h"

namespace gnomon::executor {

/// Clip space of the image, as the plan's camera or the observer camera sees it: reversed z with an infinite far plane,
/// or one behind all there is, so that clipping loses nothing behind the near one.
glm::dmat4 imageClipFromDraw(const FrameDrawing& frame);

/// How a map is drawn and looked up: where the casters' positions are taken from, and the map's image for offsets in
/// that space; the image's own origin is that space's in the frame's. It is the frame's space for most maps. A
/// stabilised one lies about its own middle, so that equal places give equal maps to the last bit, and a thin one about
/// the point that shadow::ShadowMap names.
struct MapDrawing {
    DrawSpace space;
    shadow::FloatMapImage image;

    /// Clip space of a viewport over the map's rectangle, for casters in `space`: the very floats of the lookups.
    glm::dmat4 clipFromDraw() const { return image.clipFromOffset; }
};

MapDrawing mapDrawing(const FrameDrawing& frame, const shadow::ShadowMap& map);

/// The frame's block for a pass with `clipFromDraw`, drawn in `space`.
block::Frame frameBlock(const FrameDrawing& frame, const DrawSpace& space, const glm::dmat4& clipFromDraw);

/// The partitions' block. At most GNOMON_MAX_PARTITIONS passes and GNOMON_MAX_SLICES slices.
block::Shadows shadowsBlock(const FrameDrawing& frame);

} // namespace gnomon::executor
