// The near depth of the range with an aliasing bound, quantised into steps. The steps prevent small continuous changes
// and oscillation between frames.
#pragma once

namespace gnomon::shadow {

/// The state of the quantisation, passed from frame to frame.
struct NearState {
    double near = 0;     // 0 before the first frame
    int framesAbove = 0; // number of consecutive frames that permitted a higher step
};

/// Returns the highest quantised step not above `depth` (> 0). Steps are powers of 2^(1/4), in world units.
double quantizeNear(double depth);

/// Returns the near depth of this frame: the highest step not above `minDepth`, but at least `floor`. `minDepth` is the
/// smallest view depth of the drawn surfaces. The near depth falls at once. It rises only after `framesBeforeRise`
/// consecutive frames that permit a higher step.
NearState nextNear(const NearState& previous, double minDepth, double floor, int framesBeforeRise = 15);

} // namespace gnomon::shadow
