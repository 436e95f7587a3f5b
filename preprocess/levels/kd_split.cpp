#include "preprocess/levels/kd_split.h"

#include "core/check.h"
#include "preprocess/levels/kd_cut.h"
#include "preprocess/levels/kd_gap.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>

namespace gnomon::levels {

namespace {

constexpr std::size_t kParallelPoints = 1U << 15U;

/// Divides points recursively until no part is heavier than the limit. The points are sorted by item.
struct Splitter {
    std::span<KdPoint> points;
    std::span<KdPoint> spare; // a buffer of the same size as `points`
    std::span<const std::uint32_t> weights;
    std::uint64_t maxWeight;
    double fraction;
    std::uint64_t minWeightAtGap;
    std::vector<std::uint8_t>& isEnd;

    void split(std::size_t first, std::size_t count, std::uint64_t weight) const {
        if (count <= 1 || weight <= maxWeight) {
            isEnd[first + count - 1] = 1;
            return;
        }
        const std::uint64_t parts = (weight + maxWeight - 1) / maxWeight;
        const auto lowParts = std::clamp<std::uint64_t>(
            static_cast<std::uint64_t>(std::floor(static_cast<double>(parts) * fraction + 0.5)), 1, parts - 1);
        const std::uint64_t gap = weightBeforeGap(points.subspan(first, count), weights, minWeightAtGap);
        const std::uint64_t target = gap > 0 ? gap : weight * lowParts / parts;
        const KdSide low = cutPoints(points.subspan(first, count), spare.subspan(first, count), weights, target);
        const auto splitLow = [&] { split(first, low.count, low.weight); };
        const auto splitHigh = [&] { split(first + low.count, count - low.count, weight - low.weight); };
        if (count < kParallelPoints) {
            splitLow();
            splitHigh();
        } else {
            tbb::parallel_invoke(splitLow, splitHigh);
        }
    }
};

bool isInOrder(std::span<const KdItem> items) {
    return std::is_sorted(
        items.begin(), items.end(), [](const KdItem& a, const KdItem& b) { return a.index < b.index; });
}

KdParts splitInOrder(
    std::span<const KdItem> items, std::uint64_t maxWeight, double fraction, std::uint64_t minWeightAtGap) {
    KdParts parts;
    if (items.empty()) return parts;
    std::vector<KdPoint> points(items.size());
    std::vector<KdPoint> spare(items.size());
    std::vector<std::uint32_t> weights(items.size());
    std::uint64_t weight = 0;
    for (std::uint32_t i = 0; i < items.size(); ++i) {
        GNOMON_CHECK_OP(items[i].weight, >, 0U);
        points[i] = {items[i].center, i};
        weights[i] = items[i].weight;
        weight += items[i].weight;
    }
    std::vector<std::uint8_t> isEnd(items.size(), 0);
    Splitter{points, spare, weights, maxWeight, fraction, minWeightAtGap, isEnd}.split(0, items.size(), weight);
    parts.order.resize(items.size());
    for (std::uint32_t i = 0; i < items.size(); ++i) {
        parts.order[i] = items[points[i].item].index;
        if (isEnd[i] != 0) parts.ends.push_back(i + 1);
    }
    return parts;
}

} // namespace

KdParts kdSplit(std::span<const KdItem> items, std::uint64_t maxWeight, double fraction, std::uint64_t minWeightAtGap) {
    if (isInOrder(items)) return splitInOrder(items, maxWeight, fraction, minWeightAtGap);
    std::vector<KdItem> sorted(items.begin(), items.end());
    std::sort(sorted.begin(), sorted.end(), [](const KdItem& a, const KdItem& b) { return a.index < b.index; });
    return splitInOrder(sorted, maxWeight, fraction, minWeightAtGap);
}

} // namespace gnomon::levels
