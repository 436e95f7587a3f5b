#include "shadow/quantized_near.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

double quantizeNear(double depth) {
    GNOMON_CHECK_OP(depth, >, 0.0);
    const double step = std::exp2(std::floor(std::log2(depth) * 4) / 4);
    // Because of rounding, the logarithm of a depth that is equal to a step can be slightly too small or too large.
    // Such a depth must give this step.
    const double above = step * std::exp2(0.25);
    return above <= depth * (1 + 1e-12) ? std::min(above, depth) : std::min(step, depth);
}

NearState nextNear(const NearState& previous, double minDepth, double floor, int framesBeforeRise) {
    const double wanted = std::max(quantizeNear(std::max(minDepth, floor)), floor);
    if (!(previous.near > 0) || wanted <= previous.near) return {wanted, 0};
    if (previous.framesAbove + 1 < framesBeforeRise) return {previous.near, previous.framesAbove + 1};
    return {wanted, 0};
}

} // namespace gnomon::shadow
