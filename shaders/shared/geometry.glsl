// Vertices as they lie in a page: grid points, so that two clusters agree to the bit on a border they share.
// The top bits of the coordinates carry three bits of the cluster's colour, the colour's alpha the stored error.
#include "shared/frame_block.h"

layout(location = 0) in uvec3 gridPoint;
layout(location = 1) in uint normalBits;
layout(location = 2) in vec4 colorAndError;

// Exact until the one conversion to float: both are below 2^31.
vec3 drawPosition() {
    return vec3(ivec3(gridPoint & 0x7FFFFFFFu) - originCell) * gridStep;
}
