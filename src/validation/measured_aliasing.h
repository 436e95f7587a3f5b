// Measures the perspective aliasing of shadow maps per pixel, for comparison with the upper bound of the plan.
#pragma once

#include "render/backend.h"

namespace gnomon::validation {

/// The max perspective aliasing over the pixels of a picture: the width of a shadow map texel's light beam divided by
/// the width of the pixel's beam. Both widths are measured at the visible surface point, in the map that the pixel
/// looked up.
struct MeasuredAliasing {
    double x = 0;
    double z = 0;
    // Max ratio of the measured aliasing to the aliasing bound of the map, over both axes. If the bound is valid, it is
    // at most 1.
    double overBound = 0;
    std::uint64_t pixelsMeasured = 0; // pixels with a lookup whose depth is within [near, far]
    // pixels with a lookup whose depth is outside [near, far], where the aliasing has no bound
    std::uint64_t pixelsWithoutBound = 0;

    double worst() const { return x > z ? x : z; }
};

/// Measures the perspective aliasing in the picture of `frame`, on all cores. `surfaces` are the visible surfaces of
/// this picture. With a filter, the width of a texel is multiplied by the width of the filter kernel.
MeasuredAliasing measuredAliasing(
    const render::DrawInputs& frame, const render::Raster<render::SurfaceSample>& surfaces);

} // namespace gnomon::validation
