// What a node of the tree promises of its children, and the masks of a walk against exact tests.
#include "core/random.h"
#include "lod/traversal.h"
#include "lod/tree.h"
#include "tests/support/random_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gnomon::lod {
namespace {

std::vector<Item> randomItems(Random& random, std::size_t count) {
    std::vector<Item> items(count);
    for (Item& item : items) {
        const glm::dvec3 corner = randomPoint(random, 100);
        item.box.add(corner);
        item.box.add(corner + glm::abs(randomPoint(random, 4)));
        item.bounds = {item.box.center() + randomPoint(random, 1), random.uniform(0, 5)};
        item.error = random.uniform(0, 0.1);
    }
    return items;
}

Box boxOf(const Node& node, std::size_t lane) {
    return {
        {node.min[0][lane], node.min[1][lane], node.min[2][lane]},
        {node.max[0][lane], node.max[1][lane], node.max[2][lane]}};
}

Sphere sphereOf(const Node& node, std::size_t lane) {
    return {{node.bounds[0][lane], node.bounds[1][lane], node.bounds[2][lane]}, node.bounds[3][lane]};
}

/// The items below a lane, found by walking the nodes.
std::vector<std::uint32_t> itemsBelow(const Tree& tree, const Node& node, std::size_t lane) {
    if ((node.leaves >> lane & 1U) != 0) return {node.child[lane]};
    std::vector<std::uint32_t> found;
    const Node& child = tree.nodes()[node.child[lane]];
    for (std::size_t i = 0; i < child.count; ++i)
        for (const std::uint32_t item : itemsBelow(tree, child, i))
            found.push_back(item);
    return found;
}

TEST(Node, BoundsTheBoxesTheBallsAndTheErrorsOfAllItemsBelow) {
    Random random(1);
    const std::vector<Item> items = randomItems(random, 700);
    const Tree tree(items);
    double loosest = 0;
    for (const Node& node : tree.nodes())
        for (std::size_t lane = 0; lane < node.count; ++lane) {
            Box exact;
            double error = 0;
            const Sphere ball = sphereOf(node, lane);
            const Box box = boxOf(node, lane);
            for (const std::uint32_t item : itemsBelow(tree, node, lane)) {
                exact.add(items[item].box);
                error = std::max(error, items[item].error);
                const double reach = glm::distance(ball.center, items[item].bounds.center) + items[item].bounds.radius;
                ASSERT_LE(reach, ball.radius);
                loosest = std::max(loosest, ball.radius);
            }
            ASSERT_EQ(glm::min(box.min, exact.min), box.min);
            ASSERT_EQ(glm::max(box.max, exact.max), box.max);
            // Rounded outwards by a float's step, and no more.
            EXPECT_LE(glm::distance(box.min, exact.min) + glm::distance(box.max, exact.max), 1e-4);
            EXPECT_GE(node.error[lane], error);
            EXPECT_LE(node.error[lane], error * (1 + 1e-6));
        }
    EXPECT_LT(loosest, 300) << "a ball around two is no larger than it must be";
}

TEST(Node, ChildrenFollowTheirParentsAndLeavesLieInOrder) {
    Random random(2);
    const std::vector<Item> items = randomItems(random, 300);
    const Tree tree(items);
    for (std::size_t n = 0; n < tree.nodes().size(); ++n) {
        const Node& node = tree.nodes()[n];
        ASSERT_GE(node.count, 1);
        ASSERT_LE(node.count, kWidth);
        EXPECT_EQ(node.leaves >> node.count, 0) << "no leaf beyond the last lane";
        for (std::size_t lane = 0; lane < node.count; ++lane) {
            const bool isLeaf = (node.leaves >> lane & 1U) != 0;
            EXPECT_TRUE(isLeaf || node.child[lane] > n);
        }
    }
    std::vector<std::uint32_t> walked;
    for (std::size_t lane = 0; lane < tree.nodes()[0].count; ++lane)
        for (const std::uint32_t item : itemsBelow(tree, tree.nodes()[0], lane))
            walked.push_back(item);
    EXPECT_TRUE(std::equal(walked.begin(), walked.end(), tree.order().begin(), tree.order().end()));
}

TEST(Node, NeighboursInOrderAreNeighboursInSpace) {
    Random random(3);
    const std::vector<Item> items = randomItems(random, 2000);
    const Tree tree(items);
    double inOrder = 0;
    double asGiven = 0;
    for (std::size_t i = 1; i < items.size(); ++i) {
        inOrder += glm::distance(items[tree.order()[i - 1]].box.center(), items[tree.order()[i]].box.center());
        asGiven += glm::distance(items[i - 1].box.center(), items[i].box.center());
    }
    EXPECT_LT(inOrder * 4, asGiven);
}

TEST(Tree, OneItemAndTwoEqualOnesAreFound) {
    Item item{{{-3, 0, 1}, {-2, 1, 7}}, {{0, 0, 0}, 9}, 0.5};
    for (const std::size_t count : {1U, 2U, 9U}) {
        const std::vector<Item> items(count, item);
        const Tree tree(items);
        EXPECT_EQ(tree.reach(), 7);
        std::vector<std::uint32_t> found;
        const std::vector<ConvexVolume> all(1);
        traverse(
            tree,
            all,
            [](const Sphere&, double) { return true; },
            [&](std::uint32_t i, VolumeMask mask) {
                EXPECT_EQ(mask, (VolumeMask{1, 1}));
                found.push_back(i);
            });
        EXPECT_EQ(found.size(), count);
    }
}

TEST(Tree, WhatDoesNotMatterIsNotVisited) {
    Random random(4);
    const std::vector<Item> items = randomItems(random, 500);
    const Tree tree(items);
    const std::vector<ConvexVolume> all(1);
    for (const double threshold : {0.0, 0.05, 0.09, 1.0}) {
        std::size_t visited = 0;
        traverse(
            tree,
            all,
            [&](const Sphere&, double error) { return error > threshold; },
            [&](std::uint32_t, VolumeMask) { ++visited; });
        std::size_t expected = 0;
        for (const Item& item : items)
            expected += item.error > threshold ? 1 : 0;
        EXPECT_NEAR(static_cast<double>(visited), static_cast<double>(expected), 1) << "but for a float's rounding";
    }
}

TEST(VolumeMask, UndecidedHasABitForEachVolume) {
    EXPECT_EQ(undecidedMask(0).touching, 0U);
    EXPECT_EQ(undecidedMask(1).touching, 1U);
    EXPECT_EQ(undecidedMask(7).touching, 0x7FU);
    EXPECT_EQ(undecidedMask(kMaxVolumes).touching, ~std::uint64_t{0});
    EXPECT_EQ(undecidedMask(kMaxVolumes).inside, 0U);
    EXPECT_EQ((VolumeMask{0b1110, 0b0110}.undecided()), 0b1000U);
}

// Every mask that a walk can have, narrowed to a random part: decided volumes keep their bits whatever the part is.
TEST(VolumeMask, NarrowingTestsUndecidedVolumesOnly) {
    Random random(5);
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<ConvexVolume> volumes(8);
        for (ConvexVolume& volume : volumes)
            volume.planes.push_back({glm::normalize(randomPoint(random, 1) + glm::dvec3(1e-9)), random.uniform(-2, 2)});
        VolumeMask mask;
        mask.touching = random.below(256);
        mask.inside = mask.touching & random.below(256);
        const glm::dvec3 corner = randomPoint(random, 2);
        const Box part{corner, corner + glm::abs(randomPoint(random, 1))};
        const VolumeMask found = narrowed(mask, volumes, part);
        for (std::size_t v = 0; v < 8; ++v) {
            const bool wasTouching = (mask.touching >> v & 1U) != 0;
            const bool wasInside = (mask.inside >> v & 1U) != 0;
            const Containment now = classify(volumes[v], part);
            EXPECT_EQ((found.touching >> v & 1U) != 0, wasTouching && (wasInside || now != Containment::Outside));
            EXPECT_EQ((found.inside >> v & 1U) != 0, wasInside || (wasTouching && now == Containment::Inside));
        }
    }
}

/// A node whose lanes hold the boxes.
Node nodeOf(std::span<const Box> boxes) {
    Node node;
    for (std::size_t lane = 0; lane < boxes.size(); ++lane)
        for (int axis = 0; axis < 3; ++axis) {
            node.min[static_cast<std::size_t>(axis)][lane] = static_cast<float>(boxes[lane].min[axis]);
            node.max[static_cast<std::size_t>(axis)][lane] = static_cast<float>(boxes[lane].max[axis]);
        }
    node.count = static_cast<std::uint8_t>(boxes.size());
    return node;
}

// In doubles beside the floats: never outside where the truth touches, never inside where it does not, and right
// wherever the truth is further from changing than the margin.
TEST(PreparedVolumes, AreConservativeAndTightForEveryLane) {
    Random random(6);
    int decided = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        std::vector<ConvexVolume> volumes(1 + random.below(5));
        for (ConvexVolume& volume : volumes)
            for (std::uint64_t p = random.below(7); p > 0; --p)
                volume.planes.push_back(
                    {glm::normalize(randomPoint(random, 1) + glm::dvec3(1e-9)), random.uniform(-9, 30)});
        std::vector<Box> boxes;
        for (std::size_t lane = 0; lane < kWidth; ++lane) {
            const glm::dvec3 corner = glm::dvec3(glm::vec3(randomPoint(random, 20)));
            boxes.push_back({corner, glm::dvec3(glm::vec3(corner + glm::abs(randomPoint(random, 5))))});
        }
        std::array<VolumeMask, kWidth> masks{};
        detail::PreparedVolumes(volumes, 25).classify(nodeOf(boxes), undecidedMask(volumes.size()), masks);
        for (std::size_t lane = 0; lane < kWidth; ++lane)
            for (std::size_t v = 0; v < volumes.size(); ++v) {
                const bool touching = (masks[lane].touching >> v & 1U) != 0;
                const bool inside = (masks[lane].inside >> v & 1U) != 0;
                const Containment truth = classify(volumes[v], boxes[lane]);
                EXPECT_TRUE(touching || truth == Containment::Outside);
                EXPECT_TRUE(!inside || !touching || truth == Containment::Inside);
                const bool isExact =
                    touching == (truth != Containment::Outside) && inside >= (truth == Containment::Inside);
                decided += isExact ? 1 : 0;
            }
    }
    EXPECT_GT(decided, 15000) << "the margin is a millionth of the boxes' size";
}

} // namespace
} // namespace gnomon::lod
