// Vertex pairs against every position compared with every other.
#include "preprocess/simplify/union_find.h"
#include "preprocess/simplify/vertex_pairs.h"
#include "tests/support/patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace gnomon::simplify {
namespace {

using hierarchy::kNone;

/// The least position of each one's component, spread along the triangles until nothing changes.
std::vector<std::uint32_t> componentsOf(const Patch& patch) {
    std::vector<std::uint32_t> component(patch.positions.size());
    std::iota(component.begin(), component.end(), 0U);
    for (bool changed = true; changed;) {
        changed = false;
        for (const Triangle& t : patch.triangles) {
            const std::uint32_t min = std::min({component[t[0]], component[t[1]], component[t[2]]});
            for (const std::uint32_t p : t) {
                changed = changed || component[p] != min;
                component[p] = min;
            }
        }
    }
    return component;
}

std::vector<std::uint32_t> plainPairs(const Patch& patch) {
    constexpr std::ptrdiff_t kLargestThatLooks = 24;
    const std::vector<std::uint32_t> component = componentsOf(patch);
    std::vector<std::uint32_t> pairs(component.size(), kNone);
    for (std::uint32_t p = 0; p < pairs.size(); ++p) {
        if (patch.isLocked[p] != 0) continue;
        if (std::count(component.begin(), component.end(), component[p]) > kLargestThatLooks) continue;
        double best = std::numeric_limits<double>::infinity();
        for (std::uint32_t q = 0; q < pairs.size(); ++q) {
            const glm::dvec3 d = patch.positions[p] - patch.positions[q];
            if (component[q] == component[p] || glm::dot(d, d) >= best) continue;
            best = glm::dot(d, d);
            pairs[p] = q;
        }
    }
    return pairs;
}

/// Components of the given sizes, each a strip of triangles through random points of a lattice, so that ties are many.
Patch strips(std::span<const std::uint32_t> sizes, Random& random) {
    std::vector<glm::dvec3> positions;
    std::vector<Triangle> triangles;
    for (const std::uint32_t size : sizes) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (std::uint32_t i = 0; i < size; ++i) {
            positions.emplace_back(random.below(6), random.below(6), random.below(6));
            if (i >= 2) triangles.push_back({first + i - 2, first + i - 1, first + i});
        }
    }
    Patch patch = plainPatch(std::move(positions), std::move(triangles));
    for (std::uint8_t& isLocked : patch.isLocked)
        isLocked = random.below(5) == 0 ? 1 : 0;
    return patch;
}

TEST(VertexPairs, AreTheNearestPositionsOfOtherComponents) {
    Random random(3);
    const std::vector<std::vector<std::uint32_t>> shapes{
        {3, 3}, {24, 25, 5}, {23, 24, 26}, {40, 3, 3, 7}, {4, 4, 4, 4}};
    for (const std::vector<std::uint32_t>& sizes : shapes)
        for (int run = 0; run < 40; ++run) {
            const Patch patch = strips(sizes, random);
            ASSERT_EQ(vertexPairs(patch), plainPairs(patch));
        }
}

TEST(VertexPairs, AreNoneWhereNoPositionLooksForOne) {
    Random random(4);
    EXPECT_TRUE(vertexPairs(strips(std::vector<std::uint32_t>{12}, random)).empty());     // one component
    EXPECT_TRUE(vertexPairs(strips(std::vector<std::uint32_t>{30, 30}, random)).empty()); // large ones alone
    Patch locked = strips(std::vector<std::uint32_t>{5, 5}, random);
    locked.isLocked.assign(locked.positions.size(), 1);
    EXPECT_TRUE(vertexPairs(locked).empty());
}

TEST(UnionFind, TheLeastIdIsTheRootInAnyOrderOfUnions) {
    Random random(5);
    for (int run = 0; run < 200; ++run) {
        const auto count = static_cast<std::uint32_t>(1 + random.below(40));
        UnionFind sets(count);
        std::vector<std::uint32_t> plain(count);
        std::iota(plain.begin(), plain.end(), 0U);
        for (std::uint64_t unions = random.below(60); unions > 0; --unions) {
            const auto a = static_cast<std::uint32_t>(random.below(count));
            const auto b = static_cast<std::uint32_t>(random.below(count));
            sets.unite(a, b);
            const auto [min, max] = std::minmax(plain[a], plain[b]);
            std::replace(plain.begin(), plain.end(), std::uint32_t{max}, std::uint32_t{min});
        }
        std::uint32_t roots = 0;
        for (std::uint32_t id = 0; id < count; ++id) {
            ASSERT_EQ(sets.root(id), plain[id]);
            roots += plain[id] == id ? 1 : 0;
        }
        ASSERT_EQ(sets.count(), roots);
    }
}

} // namespace
} // namespace gnomon::simplify
