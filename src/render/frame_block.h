// Filling of the uniform blocks for the shaders. Only this code converts doubles to floats.
#pragma once

#include "render/backend.h"
#include "shaders/shared/frame_block.h"

namespace gnomon::render {

/// Returns the clip space of the image for the plan's camera or the observer camera. Depth is reversed. The far plane
/// is infinite, or behind all geometry if the projection is orthographic, so only the near plane clips.
glm::dmat4 imageClipFromDraw(const DrawInputs& frame);

/// The space for drawing and looking up a map. `space` is the origin of the casters' positions, and `image` maps
/// offsets in this space to the map. The origin of `image` is the origin of `space` in the frame's space. Most maps use
/// the frame's space. A stabilised map is centred at its own middle, so that equal places give bit-identical maps. A
/// thin map uses the point that shadow::ShadowMap names.
struct MapDrawing {
    CameraRelativeSpace space;
    shadow::FloatMapImage image;

    /// Returns the clip space of a viewport over the map's rectangle, for casters in `space`. The floats are identical
    /// to those of the lookups.
    glm::dmat4 clipFromDraw() const { return image.clipFromOffset; }
};

MapDrawing mapDrawing(const DrawInputs& frame, const shadow::ShadowMap& map);

/// Returns the uniform block of a pass that draws with `clipFromDraw` in `space`.
block::Frame frameBlock(const DrawInputs& frame, const CameraRelativeSpace& space, const glm::dmat4& clipFromDraw);

/// Returns the uniform block of all partitions. The frame has at most GNOMON_MAX_PARTITIONS passes and
/// GNOMON_MAX_SLICES slices.
block::Shadows shadowsBlock(const DrawInputs& frame);

} // namespace gnomon::render
