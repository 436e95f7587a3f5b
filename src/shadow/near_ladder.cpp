#include "shadow/near_ladder.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

double nearRung(double depth) {
    GNOMON_CHECK_OP(depth, >, 0.0);
    const double rung = std::exp2(std::floor(std::log2(depth) * 4) / 4);
    // The logarithm of a rung may round to either side of it; a depth on a rung is that rung.
    const double above = rung * std::exp2(0.25);
    return above <= depth * (1 + 1e-12) ? std::min(above, depth) : std::min(rung, depth);
}

NearState nextNear(const NearState& previous, double leastDepth, double floor, int patience) {
    const double wanted = std::max(nearRung(std::max(leastDepth, floor)), floor);
    if (!(previous.near > 0) || wanted <= previous.near) return {wanted, 0};
    if (previous.framesAbove + 1 < patience) return {previous.near, previous.framesAbove + 1};
    return {wanted, 0};
}

} // namespace gnomon::shadow
