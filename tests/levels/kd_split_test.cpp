// The splitter against a plain one that sorts all items at every cut.
#include "core/random.h"
#include "preprocess/levels/kd_gap.h"
#include "preprocess/levels/kd_split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace gnomon::levels {
namespace {

using Items = std::vector<KdItem>;

int widestAxisOf(const Items& items) {
    glm::vec3 low = items.front().center;
    glm::vec3 high = low;
    for (const KdItem& item : items) {
        low = glm::min(low, item.center);
        high = glm::max(high, item.center);
    }
    const glm::vec3 size = high - low;
    const float widest = std::max({size.x, size.y, size.z});
    return size.x == widest ? 0 : (size.y == widest ? 1 : 2);
}

/// Buckets of one width, and the longest run of empty ones.
std::uint64_t weightBeforePlainGap(const Items& items, int axis, std::uint64_t minWeight) {
    float low = items.front().center[axis];
    float high = low;
    for (const KdItem& item : items) {
        low = std::min(low, item.center[axis]);
        high = std::max(high, item.center[axis]);
    }
    const float scale = 63.0F / (high - low);
    if (!std::isfinite(scale)) return 0;
    std::map<int, std::uint64_t> buckets;
    std::uint64_t total = 0;
    for (const KdItem& item : items) {
        buckets[static_cast<int>((item.center[axis] - low) * scale)] += item.weight;
        total += item.weight;
    }
    int widest = static_cast<int>(std::max(0.15, 1.5 / std::sqrt(static_cast<double>(items.size()))) * 64);
    std::uint64_t before = 0;
    std::uint64_t found = 0;
    for (auto bucket = buckets.begin(); bucket != buckets.end(); before += bucket->second, ++bucket) {
        if (bucket == buckets.begin()) continue;
        const int empty = bucket->first - std::prev(bucket)->first - 1;
        if (empty <= widest || std::min(before, total - before) < minWeight) continue;
        widest = empty;
        found = before;
    }
    return found;
}

void splitPlainly(Items items, std::uint64_t maxWeight, double fraction, std::uint64_t minWeightAtGap, KdParts& out) {
    std::uint64_t weight = 0;
    for (const KdItem& item : items)
        weight += item.weight;
    if (items.size() <= 1 || weight <= maxWeight) {
        std::sort(items.begin(), items.end(), [](const KdItem& a, const KdItem& b) { return a.index < b.index; });
        for (const KdItem& item : items)
            out.order.push_back(item.index);
        out.ends.push_back(static_cast<std::uint32_t>(out.order.size()));
        return;
    }
    const std::uint64_t parts = (weight + maxWeight - 1) / maxWeight;
    const auto lowParts = std::clamp<std::uint64_t>(
        static_cast<std::uint64_t>(std::floor(static_cast<double>(parts) * fraction + 0.5)), 1, parts - 1);
    const int axis = widestAxisOf(items);
    const std::uint64_t gap = weightBeforePlainGap(items, axis, minWeightAtGap);
    const std::uint64_t target = gap > 0 ? gap : weight * lowParts / parts;
    std::sort(items.begin(), items.end(), [&](const KdItem& a, const KdItem& b) {
        return a.center[axis] < b.center[axis] || (a.center[axis] == b.center[axis] && a.index < b.index);
    });
    std::size_t low = 0;
    for (std::uint64_t sum = items[0].weight; sum <= target; sum += items[low].weight)
        ++low;
    const auto middle = items.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(low, 1));
    splitPlainly({items.begin(), middle}, maxWeight, fraction, minWeightAtGap, out);
    splitPlainly({middle, items.end()}, maxWeight, fraction, minWeightAtGap, out);
}

void expectSplitAsPlainly(
    const Items& items, std::uint64_t maxWeight, double fraction, std::uint64_t minWeightAtGap = 0) {
    KdParts plain;
    if (!items.empty()) splitPlainly(items, maxWeight, fraction, minWeightAtGap, plain);
    const KdParts parts = kdSplit(items, maxWeight, fraction, minWeightAtGap);
    EXPECT_EQ(parts.order, plain.order);
    EXPECT_EQ(parts.ends, plain.ends);
}

enum class Spread { Even, Ties, Octaves, Zeros, Same, Outlier, Neighbours };

constexpr Spread kSpreads[] = {
    Spread::Even, Spread::Ties, Spread::Octaves, Spread::Zeros, Spread::Same, Spread::Outlier, Spread::Neighbours};

float coordinate(Spread spread, Random& random) {
    const double unit = random.unit();
    switch (spread) {
    case Spread::Even:
        return static_cast<float>(unit * 2000 - 700);
    case Spread::Ties:
        return static_cast<float>(std::floor(unit * 5) - 2);
    case Spread::Octaves: // both signs, down to what no division by is possible
        return static_cast<float>(std::ldexp(unit - 0.5, static_cast<int>(random.below(240)) - 160));
    case Spread::Zeros:
        return unit < 0.4 ? -0.0F : (unit < 0.8 ? 0.0F : std::numeric_limits<float>::denorm_min());
    case Spread::Same:
        return 3.5F;
    case Spread::Outlier:
        return unit < 0.002 ? 1e9F : static_cast<float>(unit);
    case Spread::Neighbours: // a few of the floats after 1
        return 1 + std::numeric_limits<float>::epsilon() * static_cast<float>(random.below(40));
    }
    return 0;
}

Items randomItems(std::size_t count, Spread spread, std::uint32_t maxItemWeight, Random& random) {
    Items items;
    for (std::uint32_t i = 0; i < count; ++i) {
        KdItem item;
        for (int axis = 0; axis < 3; ++axis)
            item.center[axis] = coordinate(spread, random);
        item.weight = static_cast<std::uint32_t>(1 + random.below(maxItemWeight));
        item.index = 3 * i + 7;
        items.push_back(item);
    }
    return items;
}

TEST(KdSplit, CutsAsSortingAllItemsAtEachCutDoes) {
    Random random(5);
    for (const Spread spread : kSpreads)
        for (const std::size_t count : {0U, 1U, 2U, 3U, 17U, 60U, 500U, 3000U})
            for (const std::uint32_t maxItemWeight : {1U, 40U, 3000U})
                for (const double fraction : {0.5, 0.42, 0.58}) {
                    SCOPED_TRACE(
                        testing::Message() << "spread " << static_cast<int>(spread) << ", " << count
                                           << " items, weights up to " << maxItemWeight);
                    const std::uint64_t maxWeight = 1 + random.below(200);
                    expectSplitAsPlainly(
                        randomItems(count, spread, maxItemWeight, random),
                        maxWeight,
                        fraction,
                        random.below(2) * maxWeight / 2);
                    if (testing::Test::HasFailure()) return;
                }
}

TEST(KdSplit, NoPartSpansWhatIsFarApart) {
    Random random(8);
    for (int trial = 0; trial < 50; ++trial) {
        // Two sheets: by weight alone a part would have some of both.
        Items items;
        const double share = 0.02 + 0.96 * random.unit();
        for (std::uint32_t i = 0; i < 2000; ++i) {
            const float height = random.unit() < share ? 0.0F : 3.0F;
            items.push_back({{static_cast<float>(random.unit()), static_cast<float>(random.unit()), height}, 1, i});
        }
        const KdParts parts = kdSplit(items, 128, 0.5);
        std::uint32_t begin = 0;
        for (const std::uint32_t end : parts.ends) {
            for (std::uint32_t i = begin; i < end; ++i)
                ASSERT_EQ(items[parts.order[i]].center.z, items[parts.order[begin]].center.z) << trial;
            begin = end;
        }
    }
}

TEST(KdGap, IsWideAndTheWidest) {
    const std::vector<std::uint32_t> weights(40, 2);
    std::vector<KdPoint> points;
    for (std::uint32_t i = 0; i < 40; ++i)
        points.push_back({glm::vec3(static_cast<float>(i), 0, 0), i});
    EXPECT_EQ(weightBeforeGap(points, weights, 0), 0U) << "even";
    for (std::uint32_t i = 10; i < 40; ++i)
        points[i].center.x += 20;
    EXPECT_EQ(weightBeforeGap(points, weights, 0), 20U);
    for (std::uint32_t i = 30; i < 40; ++i)
        points[i].center.x += 40;
    EXPECT_EQ(weightBeforeGap(points, weights, 0), 60U) << "wider";
    EXPECT_EQ(weightBeforeGap(points, weights, 20), 60U) << "as much on its far side";
    EXPECT_EQ(weightBeforeGap(points, weights, 21), 0U) << "neither has so much on either side";
    for (KdPoint& point : points)
        point.center.y = 1000 * point.center.x;
    EXPECT_EQ(weightBeforeGap(points, weights, 0), 60U) << "the axis of the widest spread is y now";
    for (KdPoint& point : points)
        point.center = glm::vec3(5);
    EXPECT_EQ(weightBeforeGap(points, weights, 0), 0U) << "one place";
}

TEST(KdSplit, DoesNotDependOnTheOrderOfTheItems) {
    Random random(6);
    for (const Spread spread : kSpreads) {
        Items items = randomItems(800, spread, 5, random);
        const KdParts parts = kdSplit(items, 64, 0.5);
        for (std::size_t i = items.size(); i > 1; --i)
            std::swap(items[i - 1], items[random.below(i)]);
        const KdParts shuffled = kdSplit(items, 64, 0.5);
        EXPECT_EQ(shuffled.order, parts.order);
        EXPECT_EQ(shuffled.ends, parts.ends);
    }
}

TEST(KdSplit, CutsAsPlainlyWhereThreadsShareTheWork) {
    Random random(7);
    expectSplitAsPlainly(randomItems(100'000, Spread::Even, 1, random), 128, 0.5);
    expectSplitAsPlainly(randomItems(100'000, Spread::Ties, 9, random), 2048, 0.42);
}

} // namespace
} // namespace gnomon::levels
