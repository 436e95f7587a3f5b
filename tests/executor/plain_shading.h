// The image's shading one pixel at a time, without vectors: what the kernel must give to the bit.
#pragma once

#include "executor/shading_kernel.h"

namespace gnomon::executor {

/// Does what shadePixels does.
void plainShade(const ShadingFrame& frame, PixelBatch& batch);

/// The map that the lookup of a point asks, by its position `p` from the eye (world axes) and its view depth `z`; -1
/// for none.
int plainPassOf(const ShadingFrame& f, const glm::vec3& p, float z);

/// What the maps answer at `position` (draw space) of a surface with `normal`, at `cosine` to the light: from 0 to 1.
float plainLitFraction(
    const ShadingFrame& frame, int pass, const glm::vec3& position, const glm::vec3& normal, float cosine);

} // namespace gnomon::executor
