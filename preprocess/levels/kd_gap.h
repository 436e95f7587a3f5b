// Finds a wide gap between points, where a dividing plane separates distant points.
#pragma once

#include "preprocess/levels/kd_cut.h"

namespace gnomon::levels {

/// Finds the widest gap between the centres of `points`, and returns the total weight of the points on its low side.
/// Gaps are measured along the widest axis, which is also the axis of `cutPoints`. Returns 0 if no gap is wide enough.
/// A gap must be wider than 15% of the extent, and wider than 1.5 times the spacing of points that evenly fill a
/// square. A gap with less than `minWeight` on one side is ignored. `weights` contains the weight of each item.
std::uint64_t weightBeforeGap(
    std::span<const KdPoint> points, std::span<const std::uint32_t> weights, std::uint64_t minWeight);

} // namespace gnomon::levels
