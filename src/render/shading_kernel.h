// The shading kernel: does the computations of the image's shaders on the CPU with SIMD instructions, with the same
// operations and names.
#pragma once

#include "render/shading_batch.h"

namespace gnomon::render {

/// Shades the pixels of the batch. The result does not depend on the instruction set.
void shadePixels(const ShadingFrame& frame, PixelBatch& batch);

/// Computes the lit fractions of points by lookups in the shadow maps, as `shadePixels` does with LitSource::Maps.
void lookUpShadows(const ShadingFrame& frame, PointBatch& batch);

} // namespace gnomon::render
