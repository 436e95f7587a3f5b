// Eye-dome lighting: shades creases and outlines by comparing the depths of neighbouring pixels.
#pragma once

#include "render/picture.h"

namespace gnomon::render {

/// Darkens pixels that are farther away than their neighbours, by eye-dome lighting (Boucheny 2009). `depth` has the
/// size of `picture`. It is infinite for pixels without a surface, which stay unchanged. For each pair of opposite
/// neighbours, the mean of their 1/depth is compared with the 1/depth of the pixel. In a plane both are equal, so flat
/// surfaces never become darker. With parallel primary rays, this is true for depth itself. `parallelDistance` is then
/// positive and scales the differences as if all surfaces had this distance.
void applyEyeDome(Picture& picture, const FloatPicture& depth, double parallelDistance = 0);

} // namespace gnomon::render
