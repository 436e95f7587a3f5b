// Fills the uniform blocks of the shaders. All conversions of shader parameters from double to float are in this file.
#pragma once

#include "render/backend.h"
#include "shaders/shared/frame_block.h"

namespace gnomon::render {

/// Returns the matrix from camera-relative space to the clip space of the image, for the plan's camera or the observer
/// camera. Depth is reversed. Only the near plane clips: the far plane of a perspective is infinite, and the far plane
/// of an orthographic projection is behind all geometry.
glm::dmat4 imageClipFromDraw(const DrawInputs& frame);

/// The coordinate system of a shadow map. `space` defines the origin of the casters' positions, and `image` converts
/// offsets in this space to texels of the map. The origin of `image` is the origin of `space`, in the frame's space.
/// Most maps use the frame's space. The origin for a stabilised map is the middle of the map, so that maps at equal
/// places are bit-identical. The origin for the map of a thin view is shadow::ShadowMap::origin.
struct MapDrawing {
    CameraRelativeSpace space;
    shadow::FloatMapImage image;

    /// Returns the matrix that projects the casters of the shadow map from `space` to clip space. The viewport is the
    /// map's rectangle. Shadow map lookups use identical floats.
    glm::dmat4 clipFromDraw() const { return image.clipFromOffset; }
};

MapDrawing mapDrawing(const DrawInputs& frame, const shadow::ShadowMap& map);

/// Returns the uniform block for drawing positions in `space` with the projection `clipFromDraw`.
block::Frame frameBlock(const DrawInputs& frame, const CameraRelativeSpace& space, const glm::dmat4& clipFromDraw);

/// Returns the uniform block with the parameters of all shadow maps. The frame may have at most GNOMON_MAX_PARTITIONS
/// maps and GNOMON_MAX_SLICES slices.
block::Shadows shadowsBlock(const DrawInputs& frame);

} // namespace gnomon::render
