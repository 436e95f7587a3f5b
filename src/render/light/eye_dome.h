// Eye-dome lighting: creases and outlines from depth alone, for surfaces with uniform light.
#pragma once

#include "render/picture.h"

namespace gnomon::render {

/// Darkens pixels of `picture` that are behind their neighbours, by eye-dome lighting (Boucheny 2009). `depth` has the
/// same size and is infinite without a surface; such pixels stay unchanged. For each pair of opposite neighbours, the
/// mean of 1/depth is compared with the value of the pixel. In a plane both are equal, so flat surfaces never darken.
/// With parallel primary rays, planes preserve the mean of depth itself. A positive `parallelDistance` then scales the
/// differences, as if all surfaces had this distance.
void applyEyeDome(Picture& picture, const FloatPicture& depth, double parallelDistance = 0);

} // namespace gnomon::render
