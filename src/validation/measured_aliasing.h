// Measurement of the perspective aliasing per pixel, for comparison with the bound of the plan.
#pragma once

#include "render/backend.h"

namespace gnomon::validation {

/// The max perspective aliasing over the pixels of a picture: width of a texel's beam of light divided by the width of
/// the pixel's beam. Both widths are measured at the visible surface point, in the map that the pixel looked up.
struct MeasuredAliasing {
    double x = 0;
    double z = 0;
    // Max ratio of measured aliasing to the bound of its map, over both axes. It is at most 1 if the bound is valid.
    double overBound = 0;
    std::uint64_t pixelsMeasured = 0;     // pixels with a lookup, within [near, far]
    std::uint64_t pixelsWithoutBound = 0; // pixels with a lookup outside [near, far], where no bound applies

    double worst() const { return x > z ? x : z; }
};

/// Measures the picture of `frame` that shows `surfaces`, on all cores. A filter kernel multiplies the width of a texel
/// by its own width.
MeasuredAliasing measuredAliasing(
    const render::DrawInputs& frame, const render::Raster<render::SurfaceSample>& surfaces);

} // namespace gnomon::validation
