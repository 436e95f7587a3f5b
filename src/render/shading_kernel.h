// Shades pixels on the CPU with SIMD instructions, using the same operations and names as the OpenGL shaders.
#pragma once

#include "render/shading_batch.h"

namespace gnomon::render {

/// Shades all pixels of `batch`. The result does not depend on the instruction set.
void shadePixels(const ShadingFrame& frame, PixelBatch& batch);

/// Computes the lit fraction of each point of `batch` by lookups in the shadow maps, as `shadePixels` does with
/// LitSource::Maps.
void lookUpShadows(const ShadingFrame& frame, PointBatch& batch);

} // namespace gnomon::render
