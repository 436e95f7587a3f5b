// Filling the blocks that the shaders read from a frame: the one place where doubles become floats.
#pragma once

#include "executor/executor.h"
#include "shaders/shared/frame_block.h"

namespace gnomon::executor {

/// Clip space of the image, as the plan's camera or the onlooker sees it: reversed z with an infinite far plane, so
/// that clipping loses nothing behind the near one.
glm::dmat4 imageClipFromDraw(const FrameDrawing& frame);

/// Texels of the whole depth texture: (column w, row w, depth w, w).
glm::dmat4 texelFromDraw(const plan::ShadowPass& pass, const DrawSpace& space);

/// Clip space of a viewport over the pass's rectangle.
glm::dmat4 shadowClipFromDraw(const plan::ShadowPass& pass, const DrawSpace& space);

/// How a map is drawn: a draw space, and the clip space of a viewport over the pass's rectangle. That of the frame; but
/// a stabilised map is drawn from its own middle, so that equal places give equal maps to the last bit.
struct MapDrawing {
    DrawSpace space;
    glm::dmat4 clipFromDraw{1};
};

MapDrawing mapDrawing(const FrameDrawing& frame, const plan::ShadowPass& pass);

/// The texels of `pass` along its warp's s and t, whichever way it lies in the depth texture.
shadow::Resolution texelsOf(const plan::ShadowPass& pass);

/// The frame's block for a pass with `clipFromDraw`, drawn in `space`.
block::Frame frameBlock(const FrameDrawing& frame, const DrawSpace& space, const glm::dmat4& clipFromDraw);

/// The partitions' block. At most GNOMON_MAX_PARTITIONS passes and GNOMON_MAX_SLICES slices.
block::Shadows shadowsBlock(const FrameDrawing& frame);

} // namespace gnomon::executor
