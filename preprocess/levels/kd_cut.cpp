#include "preprocess/levels/kd_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::levels {

namespace {

/// A cut position in the sorted list of points. The points on the low side are before the coordinate `value`, or at
/// this coordinate with an index below `item`.
struct Place {
    float value;
    std::uint64_t item;
    std::uint64_t weightBefore;

    /// Returns true if a point is on the low side of the cut. The comparison has no branches, because the CPU cannot
    /// predict the side of a point.
    bool isAfter(float pointValue, std::uint32_t pointItem) const {
        const unsigned isLess = pointValue < value ? 1 : 0;
        const unsigned isNoMore = pointValue <= value ? 1 : 0;
        const unsigned isEarlier = pointItem < item ? 1 : 0;
        return (isLess | (isNoMore & isEarlier)) != 0;
    }
};

/// Sorts coordinates into buckets of equal width. A larger coordinate never has a lower bucket index, in spite of
/// rounding.
class Buckets {
public:
    static constexpr std::size_t kMaxCount = 256;

    /// Creates buckets for `points` coordinates from `low` to `high`. If the range is too small for a division, there
    /// is only one bucket.
    Buckets(float low, float high, std::size_t points)
        : low_(low), count_(std::clamp<std::size_t>(points / 2, 16, kMaxCount)) {
        const float scale = static_cast<float>(count_ - 1) / (high - low);
        scale_ = std::isfinite(scale) ? scale : 0;
    }

    std::size_t count() const { return count_; }

    std::size_t of(float value) const { return static_cast<std::size_t>(static_cast<int>((value - low_) * scale_)); }

private:
    float low_;
    float scale_ = 0;
    std::size_t count_;
};

struct CutInput {
    std::span<KdPoint> points;
    std::span<KdPoint> spare;
    std::span<const std::uint32_t> weights;
    std::uint64_t target;
};

/// Finds the bucket in which the accumulated weight of the candidates reaches the target, and copies the points of the
/// bucket to the front of the spare buffer. `candidates` may already be in the spare buffer. `before` is the weight of
/// all points before the candidates. The function increases it to the weight before the found bucket. Returns the
/// number of copied points.
template <int kAxis>
std::size_t narrow(
    const CutInput& input, std::span<const KdPoint> candidates, const KdBounds& bounds, std::uint64_t& before) {
    const Buckets buckets(bounds.low[kAxis], bounds.high[kAxis], candidates.size());
    std::array<std::uint64_t, Buckets::kMaxCount> weight{};
    for (const KdPoint& point : candidates)
        weight[buckets.of(point.center[kAxis])] += input.weights[point.item];
    std::size_t bucket = 0;
    while (before + weight[bucket] <= input.target)
        before += weight[bucket++];
    std::size_t count = 0;
    for (const KdPoint& point : candidates) {
        input.spare[count] = point;
        count += buckets.of(point.center[kAxis]) == bucket ? 1 : 0;
    }
    return count;
}

/// Copies `candidates` to the spare buffer, sorts them and returns them.
template <int kAxis>
std::span<const KdPoint> sorted(const CutInput& input, std::span<const KdPoint> candidates) {
    const std::span<KdPoint> copies = input.spare.first(candidates.size());
    if (candidates.data() != copies.data()) std::copy(candidates.begin(), candidates.end(), copies.begin());
    std::sort(copies.begin(), copies.end(), [](const KdPoint& a, const KdPoint& b) {
        return a.center[kAxis] < b.center[kAxis] || (a.center[kAxis] == b.center[kAxis] && a.item < b.item);
    });
    return copies;
}

/// Finds the cut position for the target weight. The function selects the points of the bucket that reaches the target,
/// repeats this with smaller buckets, and finally sorts the few remaining points.
template <int kAxis>
Place findPlace(const CutInput& input, KdBounds bounds) {
    constexpr std::size_t kFew = 16;
    std::span<const KdPoint> candidates = input.points;
    std::uint64_t before = 0;
    while (candidates.size() > kFew && bounds.low[kAxis] < bounds.high[kAxis]) {
        const std::size_t count = narrow<kAxis>(input, candidates, bounds, before);
        if (count == candidates.size()) break;
        candidates = input.spare.first(count);
        bounds = boundsOf(candidates);
    }
    if (bounds.low[kAxis] < bounds.high[kAxis]) candidates = sorted<kAxis>(input, candidates);
    std::size_t i = 0;
    while (before + input.weights[candidates[i].item] <= input.target)
        before += input.weights[candidates[i++].item];
    const KdPoint& point = candidates[i];
    if (before > 0) return {point.center[kAxis], point.item, before};
    return {point.center[kAxis], std::uint64_t{point.item} + 1, input.weights[point.item]};
}

/// Moves the points before the cut position `place` to the front and returns their number. The loop writes each point
/// to both sides and advances only one side. It therefore needs no branches.
template <int kAxis>
std::size_t part(const CutInput& input, const Place place) {
    KdPoint* const low = input.points.data();
    KdPoint* const high = input.spare.data();
    const std::size_t count = input.points.size();
    std::size_t lows = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const KdPoint point = low[i];
        low[lows] = point;
        high[i - lows] = point;
        lows += place.isAfter(point.center[kAxis], point.item) ? 1 : 0;
    }
    std::copy_n(high, count - lows, low + lows);
    return lows;
}

/// Cuts the points perpendicular to the axis `kAxis`. The axis is a template parameter so that the short inner loops do
/// not test it.
template <int kAxis>
KdSide cutAcross(const CutInput& input, const KdBounds& bounds) {
    const Place place = findPlace<kAxis>(input, bounds);
    return {part<kAxis>(input, place), place.weightBefore};
}

} // namespace

KdBounds boundsOf(std::span<const KdPoint> points) {
    KdBounds bounds{glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())};
    for (const KdPoint& point : points) {
        bounds.low = glm::min(bounds.low, point.center);
        bounds.high = glm::max(bounds.high, point.center);
    }
    return bounds;
}

int widestAxis(const KdBounds& bounds) {
    const glm::vec3 size = bounds.high - bounds.low;
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
}

KdSide cutPoints(
    std::span<KdPoint> points, std::span<KdPoint> spare, std::span<const std::uint32_t> weights, std::uint64_t target) {
    const CutInput input{points, spare, weights, target};
    const KdBounds bounds = boundsOf(points);
    switch (widestAxis(bounds)) {
    case 0:
        return cutAcross<0>(input, bounds);
    case 1:
        return cutAcross<1>(input, bounds);
    default:
        return cutAcross<2>(input, bounds);
    }
}

} // namespace gnomon::levels
