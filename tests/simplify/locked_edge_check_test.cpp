// Locked edges against a count of the faces at every pair of positions.
#include "preprocess/simplify/locked_edge_check.h"
#include "tests/support/patches.h"

#include <gtest/gtest.h>

#include <map>

namespace gnomon::simplify {
namespace {

constexpr std::uint32_t kStarPositions = 9;

Patch randomPatch(Random& random) {
    std::vector<Triangle> triangles(6 + random.below(10));
    for (Triangle& t : triangles)
        do {
            for (std::uint32_t& corner : t)
                corner = static_cast<std::uint32_t>(random.below(kStarPositions));
        } while (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]);
    Patch patch = plainPatch(std::vector<glm::dvec3>(kStarPositions), std::move(triangles));
    for (std::uint8_t& isLocked : patch.isLocked)
        isLocked = random.below(2) == 0 ? 1 : 0;
    return patch;
}

/// How many of `triangles` have both of two positions, for each two locked ones.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> facesAtLockedEdges(
    const Patch& patch, const std::vector<Triangle>& triangles) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> faces;
    for (const Triangle& t : triangles)
        for (const std::uint32_t a : t)
            for (const std::uint32_t b : t)
                if (a < b && patch.isLocked[a] != 0 && patch.isLocked[b] != 0) ++faces[{a, b}];
    return faces;
}

TEST(LockedEdges, AreKeptIfEachHasAsManyFacesAsBefore) {
    Random random(1);
    int kept = 0;
    int lost = 0;
    for (int run = 0; run < 4000; ++run) {
        const Patch patch = randomPatch(random);
        std::vector<Triangle> triangles = patch.triangles;
        const std::size_t changed = random.below(triangles.size());
        switch (random.below(4)) {
        case 0:
            triangles.erase(triangles.begin() + static_cast<std::ptrdiff_t>(changed));
            break;
        case 1:
            triangles.push_back(triangles[changed]);
            break;
        case 2:
            std::swap(triangles[changed][0], triangles[changed][2]);
            break;
        default:
            triangles[changed][0] = static_cast<std::uint32_t>(random.below(kStarPositions));
            if (triangles[changed][0] == triangles[changed][1] || triangles[changed][0] == triangles[changed][2])
                continue;
        }
        const bool expected = facesAtLockedEdges(patch, triangles) == facesAtLockedEdges(patch, patch.triangles);
        ASSERT_EQ(keepsLockedEdges(patch, triangles), expected);
        ++(expected ? kept : lost);
    }
    EXPECT_GT(kept, 500);
    EXPECT_GT(lost, 500);
}

TEST(LockedEdges, TheRingAroundThemIsEveryPositionOfATriangleWithALockedOne) {
    Random random(2);
    for (int run = 0; run < 500; ++run) {
        Patch patch = randomPatch(random);
        if (run % 3 == 0) patch.isLocked.assign(kStarPositions, 0);
        const std::vector<std::uint8_t> found = lockedWithRing(patch);
        for (std::uint32_t p = 0; p < kStarPositions; ++p) {
            bool expected = patch.isLocked[p] != 0;
            for (const Triangle& t : patch.triangles)
                for (std::size_t i = 0; i < 3; ++i)
                    expected = expected || (t[i] == p && (patch.isLocked[t[0]] != 0 || patch.isLocked[t[1]] != 0 ||
                                                          patch.isLocked[t[2]] != 0));
            ASSERT_EQ(found[p] != 0, expected);
        }
    }
}

} // namespace
} // namespace gnomon::simplify
