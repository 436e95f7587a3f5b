// The depths that a shadow map should hold: every caster's plane in doubles, to tell which of two backends is off.
#pragma once

#include "render/backend.h"

#include <vector>

namespace gnomon::render {

/// A texel of the depth texture with the depths that two backends left there.
struct DisputedTexel {
    int x = 0;
    int y = 0;
    float ours = 0;
    float theirs = 0;
    double oursOff = 1; // distance to the nearest plane of a caster that covers the texel's middle
    double theirsOff = 1;
};

/// Fills in the distances of `texels`, all of pass `pass`. Corners are those that both backends start from: through
/// the same floats, then exact. A triangle counts if it covers the middle or a point within 1.5/256 texel of it, for
/// both snap corners to 1/256.
void judge(const DrawInputs& frame, std::size_t pass, std::vector<DisputedTexel>& texels);

} // namespace gnomon::render
