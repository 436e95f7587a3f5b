// Fills the uniform blocks of the shaders. Only this code converts doubles to floats.
#pragma once

#include "render/backend.h"
#include "shaders/shared/frame_block.h"

namespace gnomon::render {

/// Returns the matrix from camera-relative space to the clip space of the image, for the plan's camera or the observer
/// camera. Depth is reversed. In perspective, the far plane is infinite. In an orthographic projection, it is behind
/// all geometry. Therefore only the near plane clips.
glm::dmat4 imageClipFromDraw(const DrawInputs& frame);

/// The space in which a shadow map is drawn and looked up. `space` defines the origin of the casters' positions, and
/// `image` converts offsets in this space to texels of the map. The origin of `image` is the origin of `space`, in the
/// frame's space. Most maps use the frame's space. The origin for a stabilised map is the middle of the map, so that
/// maps at equal places are bit-identical. The origin for the map of a thin view is shadow::ShadowMap::origin.
struct MapDrawing {
    CameraRelativeSpace space;
    shadow::FloatMapImage image;

    /// Returns the matrix from positions of casters in `space` to clip space. The viewport is the map's rectangle. The
    /// floats are identical to the floats of the lookups.
    glm::dmat4 clipFromDraw() const { return image.clipFromOffset; }
};

MapDrawing mapDrawing(const DrawInputs& frame, const shadow::ShadowMap& map);

/// Returns the uniform block of a pass that draws in `space` with the matrix `clipFromDraw`.
block::Frame frameBlock(const DrawInputs& frame, const CameraRelativeSpace& space, const glm::dmat4& clipFromDraw);

/// Returns the uniform block with the parameters of all partitions. The frame may have at most GNOMON_MAX_PARTITIONS
/// passes and GNOMON_MAX_SLICES slices.
block::Shadows shadowsBlock(const DrawInputs& frame);

} // namespace gnomon::render
