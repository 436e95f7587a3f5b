// Where nothing lies between points that are to be cut: a cut there keeps what is far apart out of one part.
#pragma once

#include "preprocess/levels/kd_cut.h"

namespace gnomon::levels {

/// The weight of the points on the low side of the widest gap between the centers of `points`, across the axis along
/// which they are spread widest, where `cutPoints` cuts; 0 if no gap is wide enough: more than 15% of the spread, and
/// more than points that fill a square evenly leave between each other. Gaps with less than `leastWeight` on a side do
/// not count. `weights` are those of all items.
std::uint64_t weightBeforeGap(
    std::span<const KdPoint> points, std::span<const std::uint32_t> weights, std::uint64_t leastWeight);

} // namespace gnomon::levels
