// Vertices in page format. Positions are grid points, so two clusters agree to the bit on a shared border. The top bits
// of the coordinates store three bits of the cluster's colour index, and the colour's alpha stores the stored error.
#include "shared/frame_block.h"

layout(location = 0) in uvec3 gridPoint;
layout(location = 1) in uint normalBits;
layout(location = 2) in vec4 colorAndError;

// Returns the position in camera-relative space. Integers are below 2^31, so only the conversion to float rounds.
vec3 drawPosition() {
    return vec3(ivec3(gridPoint & 0x7FFFFFFFu) - originCell) * gridStep;
}
