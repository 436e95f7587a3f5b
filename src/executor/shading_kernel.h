// What the image's shaders compute, for the visible pixels in vector lanes: the same operations in the same names.
#pragma once

#include "executor/shading_batch.h"

namespace gnomon::executor {

/// Shades the batch; the result does not depend on the instruction set.
void shadePixels(const ShadingFrame& frame, PixelBatch& batch);

/// Finds the lit fraction of the points as `shadePixels` does with LitSource::Maps.
void lookUpShadows(const ShadingFrame& frame, PointBatch& batch);

} // namespace gnomon::executor
