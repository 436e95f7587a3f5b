// The perspective aliasing that a picture has, pixel by pixel, to stand beside the one that its plan promised.
#pragma once

#include "executor/executor.h"

namespace gnomon::proof {

/// The largest over the pixels of one picture: width of a texel's light beam over width of the pixel's image beam, at
/// the surface point that the pixel shows, in the map that it looked up.
struct MeasuredAliasing {
    double x = 0;
    double z = 0;
    double overPromise = 0; // the largest share of its own map's promise, either axis; at most 1 if it is kept
    std::uint64_t pixelsMeasured = 0;   // those that looked up a map, within [near, far]
    std::uint64_t pixelsUnpromised = 0; // those that looked one up outside [near, far], where nothing is promised

    double worst() const { return x > z ? x : z; }
};

/// Measures the picture of `frame` that shows `surfaces`, on all cores. A filter widens the texel by its kernel.
MeasuredAliasing measuredAliasing(
    const executor::FrameDrawing& frame, const executor::Raster<executor::SurfaceSample>& surfaces);

} // namespace gnomon::proof
