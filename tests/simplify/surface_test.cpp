// A surface's neighbours and nearest triangles against a look at all of them.
#include "core/random.h"
#include "preprocess/simplify/surface.h"
#include "preprocess/simplify/triangle_adjacency.h"
#include "tests/support/patches.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::simplify {
namespace {

using hierarchy::kNone;

TEST(Surface, AcrossAnEdgeIsTheFirstOtherTriangleThatHasIt) {
    const Patch patch = patchOf(mixedMesh());
    const Surface surface(patch.positions, patch.triangles);
    ASSERT_EQ(surface.triangles(), patch.triangles);
    for (std::uint32_t t = 0; t < patch.triangles.size(); ++t)
        for (std::uint32_t i = 0; i < 3; ++i) {
            const std::uint32_t a = patch.triangles[t][i];
            const std::uint32_t b = patch.triangles[t][(i + 1) % 3];
            std::uint32_t expected = kNone;
            for (std::uint32_t u = 0; u < patch.triangles.size() && expected == kNone; ++u)
                if (u != t && has(patch.triangles[u], a) && has(patch.triangles[u], b)) expected = u;
            ASSERT_EQ(surface.across(t, i), expected);
            ASSERT_EQ(surface.corner(t, i), patch.positions[a]);
        }
}

TEST(Surface, AroundAPositionAreAllTrianglesThatHaveItAscending) {
    const Patch patch = patchOf(mixedMesh());
    const Surface surface(patch.positions, patch.triangles);
    const TriangleAdjacency adjacency(patch.positions.size(), patch.triangles);
    for (std::uint32_t p = 0; p < patch.positions.size(); ++p) {
        std::vector<std::uint32_t> expected;
        for (std::uint32_t t = 0; t < patch.triangles.size(); ++t)
            if (has(patch.triangles[t], p)) expected.push_back(t);
        for (const auto found : {surface.around(p), adjacency.around(p)})
            ASSERT_EQ(std::vector<std::uint32_t>(found.begin(), found.end()), expected);
    }
}

TEST(Surface, TheNearestTriangleIsNoFartherThanAnyOther) {
    const Patch patch = patchOf(mixedMesh());
    Surface surface(patch.positions, patch.triangles);
    Random random(5);
    for (int run = 0; run < 500; ++run) {
        const double x = random.uniform(900, 2100);
        const double y = random.uniform(900, 2100);
        const glm::dvec3 p(x, y, random.uniform(900, 2100));
        double min = std::numeric_limits<double>::infinity();
        for (std::uint32_t t = 0; t < patch.triangles.size(); ++t)
            min = std::min(min, surface.squaredDistance(p, t));
        ASSERT_EQ(surface.squaredDistance(p, surface.nearest(p)), min);
    }
}

} // namespace
} // namespace gnomon::simplify
