#include "core/random.h"
#include "lod/traversal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

namespace gnomon::lod {
namespace {

glm::dvec3 pointWithin(Random& random, double reach) {
    return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

std::vector<Item> randomItems(Random& random, std::size_t count, const glm::dvec3& offset) {
    std::vector<Item> items(count);
    for (Item& item : items) {
        const glm::dvec3 corner = offset + pointWithin(random, 100);
        item.box.add(corner);
        item.box.add(corner + glm::abs(pointWithin(random, 4)));
        item.bounds = {item.box.center(), glm::length(item.box.extent()) * random.uniform(0.5, 2)};
        item.error = random.below(50) == 0 ? std::numeric_limits<double>::infinity() : random.uniform(0, 0.1);
    }
    return items;
}

ConvexVolume randomVolume(Random& random, const glm::dvec3& offset) {
    ConvexVolume volume;
    const std::uint64_t count = random.below(9);
    for (std::uint64_t i = 0; i < count; ++i) {
        const glm::dvec3 normal = glm::normalize(pointWithin(random, 1) + glm::dvec3(1e-9));
        volume.planes.push_back({normal, random.uniform(-20, 60) - glm::dot(normal, offset)});
    }
    return volume;
}

// The truth beside the tree: every item against every volume, in doubles.
std::vector<std::uint64_t> touchedByEach(std::span<const Item> items, std::span<const ConvexVolume> volumes) {
    std::vector<std::uint64_t> result(items.size());
    for (std::size_t i = 0; i < items.size(); ++i)
        for (std::size_t v = 0; v < volumes.size(); ++v)
            if (classify(volumes[v], items[i].box) != Containment::Outside) result[i] |= std::uint64_t{1} << v;
    return result;
}

void compareWithBruteForce(Random& random, std::size_t count, const glm::dvec3& offset) {
    const std::vector<Item> items = randomItems(random, count, offset);
    const Tree tree(items);
    std::vector<ConvexVolume> volumes(1 + random.below(6));
    for (ConvexVolume& volume : volumes)
        volume = randomVolume(random, offset);
    const glm::dvec3 eye = offset + pointWithin(random, 150);
    const double threshold = random.uniform(0, 0.01);
    const auto matters = [&](const Sphere& bounds, double error) { return error > threshold * distance(bounds, eye); };
    const std::vector<std::uint64_t> truth = touchedByEach(items, volumes);
    std::vector<int> visits(items.size(), 0);
    std::size_t extra = 0;
    traverse(tree, volumes, matters, [&](std::uint32_t item, VolumeMask mask) {
        ++visits[item];
        EXPECT_EQ(truth[item] & ~mask.touching, 0U) << "a touched volume was lost";
        EXPECT_EQ(mask.inside & ~mask.touching, 0U);
        for (std::size_t v = 0; v < volumes.size(); ++v)
            EXPECT_FALSE((mask.inside >> v & 1U) != 0 && (truth[item] >> v & 1U) == 0);
        EXPECT_EQ(narrowed(mask, volumes, items[item].box).touching & ~mask.inside, truth[item] & ~mask.inside);
        if (truth[item] == 0) ++extra;
    });
    for (std::size_t i = 0; i < items.size(); ++i) {
        EXPECT_LE(visits[i], 1);
        const bool wanted = truth[i] != 0 && matters(items[i].bounds, items[i].error);
        EXPECT_GE(visits[i], wanted ? 1 : 0) << i;
    }
    EXPECT_LE(extra, items.size() / 50 + 1) << "the margin lets through what it should not";
}

TEST(Tree, TraversalFindsWhatBruteForceFinds) {
    Random random(11);
    for (int trial = 0; trial < 300; ++trial)
        compareWithBruteForce(random, 1 + random.below(600), glm::dvec3(0));
}

TEST(Tree, TraversalFindsWhatBruteForceFindsFarFromTheOrigin) {
    Random random(12);
    for (int trial = 0; trial < 100; ++trial)
        compareWithBruteForce(random, 1 + random.below(600), pointWithin(random, 1e5));
}

TEST(Tree, HoldsEveryItemOnceAndBoundsItsChildren) {
    Random random(13);
    const std::vector<Item> items = randomItems(random, 5000, glm::dvec3(0));
    const Tree tree(items);
    std::vector<std::uint32_t> order(tree.order().begin(), tree.order().end());
    std::sort(order.begin(), order.end());
    ASSERT_EQ(order.size(), items.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        EXPECT_EQ(order[i], i);
    EXPECT_LT(tree.nodes().size(), items.size() / 3) << "nodes are to be wide";
}

TEST(Tree, SameItemsGiveTheSameTree) {
    Random random(14);
    const std::vector<Item> items = randomItems(random, 3000, glm::dvec3(0));
    const Tree a(items);
    const Tree b(items);
    ASSERT_EQ(a.nodes().size(), b.nodes().size());
    EXPECT_TRUE(std::equal(a.order().begin(), a.order().end(), b.order().begin()));
}

TEST(Tree, WithoutItemsVisitsNothing) {
    const Tree tree(std::span<const Item>{});
    const std::vector<ConvexVolume> everywhere(1);
    traverse(
        tree, everywhere, [](const Sphere&, double) { return true; }, [](std::uint32_t, VolumeMask) { FAIL(); });
}

} // namespace
} // namespace gnomon::lod
