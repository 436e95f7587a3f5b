// The near depth that shadows are promised from: in quantised steps, so that it neither creeps nor jumps back and
// forth.
#pragma once

namespace gnomon::shadow {

/// What the quantisation remembers from frame to frame.
struct NearState {
    double near = 0;     // 0 before the first frame
    int framesAbove = 0; // how many frames in a row would have allowed a higher step
};

/// The highest quantised step, a power of 2^(1/4) world units, that is not above `depth` (> 0).
double quantizeNear(double depth);

/// The near depth of this frame: the step under `leastDepth`, the least view depth of anything drawn in the frustum,
/// but not under `floor`. It falls at once and rises only after `framesBeforeRise` frames that all allow it.
NearState nextNear(const NearState& previous, double leastDepth, double floor, int framesBeforeRise = 15);

} // namespace gnomon::shadow
