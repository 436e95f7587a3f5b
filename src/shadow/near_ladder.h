// The near depth that shadows are promised from: on a ladder, so that it neither creeps nor jumps back and forth.
#pragma once

namespace gnomon::shadow {

/// What the ladder remembers from frame to frame.
struct NearState {
    double near = 0;     // 0 before the first frame
    int framesAbove = 0; // how many frames in a row would have allowed a higher rung
};

/// The highest rung, a power of 2^(1/4) world units, that is not above `depth` (> 0).
double nearRung(double depth);

/// The near depth of this frame: the rung under `leastDepth`, the least view depth of anything drawn in the frustum,
/// but not under `floor`. It falls at once and rises only after `patience` frames that all allow it.
NearState nextNear(const NearState& previous, double leastDepth, double floor, int patience = 15);

} // namespace gnomon::shadow
