#include "preprocess/levels/kd_gap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::levels {

namespace {

constexpr std::size_t kBuckets = 64;
constexpr double kMinShare = 0.15;
// The min width of a gap, as a multiple of the distance between n points that are evenly spread over a unit square.
// This distance is 1 / sqrt(n).
constexpr double kMinSpacings = 1.5;

} // namespace

std::uint64_t weightBeforeGap(
    std::span<const KdPoint> points, std::span<const std::uint32_t> weights, std::uint64_t minWeight) {
    const KdBounds bounds = boundsOf(points);
    const int axis = widestAxis(bounds);
    const float low = bounds.low[axis];
    const float scale = static_cast<float>(kBuckets - 1) / (bounds.high[axis] - low);
    if (!std::isfinite(scale)) return 0;
    std::array<std::uint64_t, kBuckets> weight{};
    std::uint64_t total = 0;
    for (const KdPoint& point : points) {
        weight[static_cast<std::size_t>(static_cast<int>((point.center[axis] - low) * scale))] += weights[point.item];
        total += weights[point.item];
    }
    const double minShare = std::max(kMinShare, kMinSpacings / std::sqrt(static_cast<double>(points.size())));
    auto widest = static_cast<std::size_t>(minShare * kBuckets);
    std::uint64_t before = 0;
    std::uint64_t found = 0;
    std::size_t empty = 0;
    for (const std::uint64_t own : weight) {
        if (own == 0) {
            ++empty;
            continue;
        }
        if (empty > widest && before >= minWeight && total - before >= minWeight) {
            widest = empty;
            found = before;
        }
        empty = 0;
        before += own;
    }
    return found;
}

} // namespace gnomon::levels
