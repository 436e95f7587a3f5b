// The octree of counts against the points themselves: every chunk within its limit, along the space-filling order.
#include "core/random.h"
#include "hierarchy/bytes.h"
#include "preprocess/chunk/chunk_tree.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace gnomon::chunk {
namespace {

using hierarchy::GridPoint;

/// Points and the weight of each.
using Weights = std::map<GridPoint, std::uint32_t>;

Weights randomWeights(Random& random, std::uint32_t furthest, std::size_t count) {
    Weights weights;
    const auto coordinate = [&](std::uint32_t around) {
        // Half of all in a corner, so that some cells must be cut finer than others.
        return static_cast<std::uint32_t>(random.below(random.below(2) == 0 ? around : furthest + 1));
    };
    for (std::size_t i = 0; i < count; ++i)
        weights[{coordinate(furthest / 100 + 1), coordinate(furthest / 100 + 1), coordinate(furthest / 100 + 1)}] +=
            static_cast<std::uint32_t>(1 + random.below(7));
    return weights;
}

ChunkTree treeOf(const Weights& weights, std::uint32_t furthest, std::uint64_t limit, int* passes = nullptr) {
    CellCounts counts({furthest, furthest, furthest});
    int count = 0;
    do {
        for (const auto& [point, weight] : weights)
            counts.add(point, weight);
        ++count;
    } while (counts.refine(limit / 8));
    if (passes != nullptr) *passes = count;
    return {counts, limit};
}

/// The place of a point along the curve: bits of x, y and z by turns, x lowest.
std::array<std::uint32_t, 4> mortonKey(const GridPoint& p) {
    std::array<std::uint32_t, 4> key{};
    for (unsigned bit = 0; bit < 31; ++bit)
        for (unsigned axis = 0; axis < 3; ++axis) {
            const std::uint32_t value = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
            const unsigned place = 3 * bit + axis;
            key.at(3 - place / 32) |= (value >> bit & 1U) << (place % 32);
        }
    return key;
}

TEST(ChunkTree, KeepsItsLimitAndFollowsTheCurve) {
    Random random(1);
    for (const std::uint32_t furthest : {1U, 100U, 127U, 128U, 100000U, (1U << 30U)}) {
        for (const std::uint64_t limit : {40U, 400U, 100000U}) {
            const Weights weights = randomWeights(random, furthest, 3000);
            const ChunkTree tree = treeOf(weights, furthest, limit);
            std::vector<std::uint64_t> sums(tree.chunkCount());
            std::map<std::array<std::uint32_t, 4>, std::uint32_t> alongCurve;
            std::vector<std::uint64_t> points(tree.chunkCount());
            for (const auto& [point, weight] : weights) {
                const std::uint32_t chunk = tree.chunkOf(point);
                ASSERT_LT(chunk, tree.chunkCount());
                sums[chunk] += weight;
                ++points[chunk];
                alongCurve[mortonKey(point)] = chunk;
            }
            std::uint64_t total = 0;
            for (std::size_t c = 0; c < sums.size(); ++c) {
                EXPECT_GT(sums[c], 0U) << "no chunk is empty";
                EXPECT_TRUE(sums[c] <= limit || points[c] == 1) << "only a single point may weigh more";
                total += sums[c];
            }
            std::uint32_t last = 0;
            for (const auto& [key, chunk] : alongCurve) {
                EXPECT_GE(chunk, last) << "chunks are runs of the curve";
                last = chunk;
            }
            // Two that follow each other weigh more than the limit less what is left whole, or they would be one.
            EXPECT_LE(tree.chunkCount(), 2 + 2 * total / (limit - limit / 8) + points.size() / 50);
        }
    }
}

TEST(ChunkTree, DoesNotDependOnTheOrderOfThePoints) {
    Random random(2);
    const Weights weights = randomWeights(random, 5000, 2000);
    const ChunkTree forwards = treeOf(weights, 5000, 300);
    const std::vector<std::pair<GridPoint, std::uint32_t>> backwardsPoints(weights.rbegin(), weights.rend());
    CellCounts counts({5000, 5000, 5000});
    do {
        for (const auto& [point, weight] : backwardsPoints)
            for (std::uint32_t i = 0; i < weight; ++i)
                counts.add(point, 1);
    } while (counts.refine(300 / 8));
    const ChunkTree backwards(counts, 300);
    ASSERT_EQ(forwards.chunkCount(), backwards.chunkCount());
    for (const auto& [point, weight] : weights)
        EXPECT_EQ(forwards.chunkOf(point), backwards.chunkOf(point));
}

void addInThreeParts(const Weights& weights, const GridPoint& furthest, int rootBits, CellCounts& sum) {
    for (std::size_t part = 0; part < 3; ++part) {
        CellCounts counts(furthest, sum.shape(), rootBits);
        std::size_t i = 0;
        for (const auto& [point, weight] : weights)
            if (i++ % 3 == part) counts.add(point, weight);
        sum.addOpenWeights(counts.openWeights());
    }
}

// As processes do that know a part of the points each.
TEST(CellCounts, OfPartsAddUpToTheTreeOfAll) {
    Random random(9);
    for (const int rootBits : {2, 5, CellCounts::kMaxRootBits}) {
        const Weights weights = randomWeights(random, 5000, 3000);
        const GridPoint furthest{5000, 5000, 5000};
        constexpr std::uint64_t kLimit = 200;
        CellCounts all(furthest);
        do {
            for (const auto& [point, weight] : weights)
                all.add(point, weight);
        } while (all.refine(kLimit / 8));
        CellCounts sum(furthest, rootBits);
        do {
            addInThreeParts(weights, furthest, rootBits, sum);
        } while (sum.refine(kLimit / 8));
        const ChunkTree expected(all, kLimit);
        const ChunkTree tree(sum, kLimit);
        const ChunkTree back(tree.encoded());
        EXPECT_GT(tree.chunkCount(), 20U);
        EXPECT_EQ(tree.chunkCount(), expected.chunkCount());
        EXPECT_EQ(back.chunkCount(), expected.chunkCount());
        for (const auto& [point, weight] : weights) {
            ASSERT_EQ(tree.chunkOf(point), expected.chunkOf(point));
            ASSERT_EQ(back.chunkOf(point), expected.chunkOf(point));
        }
        const std::vector<std::byte> bytes = tree.encoded();
        EXPECT_THROW(ChunkTree(std::span(bytes).first(bytes.size() / 2)), hierarchy::Damage);
    }
}

TEST(CellCounts, ACellIsCutAboveTheLimitAndNotAtIt) {
    CellCounts counts({1000, 1000, 1000});
    counts.add({3, 3, 3}, 20);
    EXPECT_FALSE(counts.refine(20));
    CellCounts more({1000, 1000, 1000});
    more.add({3, 3, 3}, 21);
    EXPECT_TRUE(more.refine(20));
}

TEST(CellCounts, APointIsHeavyAboveTheLimitAndNotAtIt) {
    CellCounts counts({3, 3, 3});
    counts.add({1, 2, 3}, 20);
    counts.add({0, 1, 0}, 21);
    EXPECT_EQ(counts.pointsAbove(20), (std::vector<GridPoint>{{0, 1, 0}}));
    EXPECT_EQ(counts.pointsAbove(19), (std::vector<GridPoint>{{0, 1, 0}, {1, 2, 3}}));
}

TEST(ChunkTree, LightSourcesAreOneChunkAfterOnePass) {
    int passes = 0;
    const Weights weights{{{0, 0, 0}, 3}, {{1000, 1000, 1000}, 4}};
    const ChunkTree tree = treeOf(weights, 1000, 100, &passes);
    EXPECT_EQ(passes, 1);
    EXPECT_EQ(tree.chunkCount(), 1U);
    EXPECT_EQ(tree.chunkOf({0, 0, 0}), tree.chunkOf({1000, 1000, 1000}));
}

TEST(ChunkTree, APointIsHeavyAboveAnEighthOfTheLimit) {
    const Weights weights{{{1, 0, 0}, 85}, {{0, 1, 0}, 90}, {{0, 0, 1}, 91}, {{1, 1, 1}, 300}};
    const std::vector<GridPoint> heavy = treeOf(weights, 1, 720).heavyPoints();
    EXPECT_EQ(std::set<GridPoint>(heavy.begin(), heavy.end()), (std::set<GridPoint>{{0, 0, 1}, {1, 1, 1}}));
}

TEST(ChunkTree, AHeavyPointHasAChunkOfItsOwnHoweverHeavy) {
    const Weights weights{{{512, 512, 512}, 100000}, {{513, 512, 512}, 1}, {{0, 0, 0}, 1}};
    const ChunkTree tree = treeOf(weights, 1000, 100);
    EXPECT_NE(tree.chunkOf({512, 512, 512}), tree.chunkOf({0, 0, 0}));
    EXPECT_NE(tree.chunkOf({512, 512, 512}), tree.chunkOf({513, 512, 512}));
}

} // namespace
} // namespace gnomon::chunk
