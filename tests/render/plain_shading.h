// The image's shading one pixel at a time, without vectors: what the kernel must give to the bit.
#pragma once

#include "render/shading_kernel.h"

namespace gnomon::render {

/// Does what shadePixels does.
void plainShade(const ShadingFrame& frame, PixelBatch& batch);

} // namespace gnomon::render
