// One cut against points that are sorted: the low side as heavy as it may be, both sides in the order of their items.
#include "core/random.h"
#include "preprocess/levels/kd_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace gnomon::levels {
namespace {

std::vector<KdPoint> randomPoints(std::size_t count, double spread, int widest, Random& random) {
    std::vector<KdPoint> points(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        points[i].item = i;
        for (int axis = 0; axis < 3; ++axis)
            points[i].center[axis] =
                static_cast<float>(std::floor(random.uniform(0, spread)) * (axis == widest ? 3 : 1));
    }
    return points;
}

TEST(KdCut, PartsTheWidestAxisAtTheLastPointThatFits) {
    Random random(1);
    for (int run = 0; run < 600; ++run) {
        const int widest = run % 3;
        const std::size_t count = 2 + random.below(400);
        std::vector<KdPoint> points = randomPoints(count, run % 2 == 0 ? 5 : 1e6, widest, random);
        points[0].center[widest] = -4e6F; // surely the widest
        std::vector<std::uint32_t> weights(count);
        std::uint64_t sum = 0;
        for (std::uint32_t& weight : weights)
            sum += weight = static_cast<std::uint32_t>(1 + random.below(9));
        const std::uint64_t target = random.below(sum);
        std::vector<KdPoint> sorted = points;
        std::sort(sorted.begin(), sorted.end(), [&](const KdPoint& a, const KdPoint& b) {
            return a.center[widest] < b.center[widest] || (a.center[widest] == b.center[widest] && a.item < b.item);
        });
        std::size_t low = 0;
        std::uint64_t weight = 0;
        while (weight + weights[sorted[low].item] <= target)
            weight += weights[sorted[low++].item];
        if (low == 0) weight = weights[sorted[low++].item]; // neither side is empty
        std::vector<KdPoint> spare(count);
        const KdSide side = cutPoints(points, spare, weights, target);
        ASSERT_EQ(side.count, low);
        ASSERT_EQ(side.weight, weight);
        const auto byItem = [](const KdPoint& a, const KdPoint& b) { return a.item < b.item; };
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(low);
        std::sort(sorted.begin(), middle, byItem);
        std::sort(middle, sorted.end(), byItem);
        for (std::size_t i = 0; i < count; ++i)
            ASSERT_EQ(points[i].item, sorted[i].item);
    }
}

} // namespace
} // namespace gnomon::levels
