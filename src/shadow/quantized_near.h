// Rounds the near depth of a view to steps, so that it neither changes continuously nor oscillates between frames.
// Shadow aliasing has an upper bound from this depth on.
#pragma once

namespace gnomon::shadow {

/// The rounded near depth of a view, passed from frame to frame.
struct NearState {
    double near = 0;     // 0 before the first frame
    int framesAbove = 0; // number of consecutive frames that permitted a higher step
};

/// Returns `depth` (> 0) rounded down to a power of 2^(1/4), in world units.
double quantizeNear(double depth);

/// Returns the rounded near depth of this frame: the highest power of 2^(1/4) not above `minDepth`, but at least
/// `floor`. `minDepth` is the smallest view depth of the drawn surfaces. If a surface comes nearer, the near depth
/// falls at once. It rises only after `framesBeforeRise` consecutive frames that permit a higher step.
NearState nextNear(const NearState& previous, double minDepth, double floor, int framesBeforeRise = 15);

} // namespace gnomon::shadow
