// The shading kernel: the computations of the image's shaders with vector instructions, with the same operations and
// names.
#pragma once

#include "render/shading_batch.h"

namespace gnomon::render {

/// Shades the batch. The result does not depend on the instruction set.
void shadePixels(const ShadingFrame& frame, PixelBatch& batch);

/// Computes the lit fraction of the points, as `shadePixels` does with LitSource::Maps.
void lookUpShadows(const ShadingFrame& frame, PointBatch& batch);

} // namespace gnomon::render
