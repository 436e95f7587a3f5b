// Shading of the image pixel by pixel without vector instructions. The kernel must give bit-identical results.
#pragma once

#include "render/shading_kernel.h"

namespace gnomon::render {

/// Computes the same results as shadePixels.
void plainShade(const ShadingFrame& frame, PixelBatch& batch);

/// Returns the map for the lookup of a point, or -1. `p` is its position relative to the eye in world axes, and `z` its
/// view depth.
int plainPassOf(const ShadingFrame& f, const glm::vec3& p, float z);

/// Returns the lit fraction, from 0 to 1, at `position` (camera-relative space) of a surface with `normal`. `cosine` is
/// the cosine to the light.
float plainLitFraction(
    const ShadingFrame& frame, int pass, const glm::vec3& position, const glm::vec3& normal, float cosine);

} // namespace gnomon::render
