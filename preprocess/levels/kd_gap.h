// Finds a wide gap between points. A cut in the gap separates distant points.
#pragma once

#include "preprocess/levels/kd_cut.h"

namespace gnomon::levels {

/// Returns the weight of the points on the low side of the widest gap between the centres. The gap is measured along
/// the widest axis, like the cuts of `cutPoints`. Returns 0 if no gap is wide enough. A gap must exceed 15% of the
/// extent, and 1.5 times the spacing of points that evenly fill a square. Gaps with less than `minWeight` on one side
/// do not count. `weights` contains the weight of each item.
std::uint64_t weightBeforeGap(
    std::span<const KdPoint> points, std::span<const std::uint32_t> weights, std::uint64_t minWeight);

} // namespace gnomon::levels
