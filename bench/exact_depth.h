// Computes the exact depths of shadow map texels in double precision, to find the depth error of two backends.
#pragma once

#include "render/backend.h"

#include <vector>

namespace gnomon::render {

/// A texel of the shadow map texture in which two backends have different depths.
struct DisputedTexel {
    int x = 0;
    int y = 0;
    float ours = 0;       // depth in the first backend, 0 to 1
    float theirs = 0;     // depth in the second backend, 0 to 1
    double oursOff = 1;   // distance from `ours` to the nearest plane of a triangle that covers the texel centre
    double theirsOff = 1; // distance from `theirs` to the nearest such plane
};

/// Computes `oursOff` and `theirsOff` of all `texels`, which belong to the shadow map of pass `pass`. The corners of
/// the casters are computed from the same floats as in both backends, and then in double precision. Both backends snap
/// corners to 1/256 texel. A triangle therefore also covers a texel if it covers a point 1.5/256 texel from the centre.
void judge(const DrawInputs& frame, std::size_t pass, std::vector<DisputedTexel>& texels);

} // namespace gnomon::render
