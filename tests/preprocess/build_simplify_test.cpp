// The simplifier by itself: what it may never do.
#include "preprocess/build/simplify.h"

#include <gtest/gtest.h>

namespace gnomon::preprocess {
namespace {

TEST(Simplify, AnEarOnALockedEdgeStaysHoweverFewTrianglesAreWanted) {
    // Two triangles, each hanging with one free corner on an edge that the group on its other side counts on.
    Patch patch;
    for (const double x : {0.0, 10.0}) {
        const auto first = static_cast<std::uint32_t>(patch.positions.size());
        for (const glm::dvec3 p : {glm::dvec3(x, 0, 0), glm::dvec3(x + 4, 0, 0), glm::dvec3(x + 2, 3, 0)}) {
            hierarchy::Vertex vertex;
            vertex.position = {
                static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y), static_cast<std::uint32_t>(p.z)};
            patch.vertices.push_back(vertex);
            patch.positionOf.push_back(static_cast<std::uint32_t>(patch.positions.size()));
            patch.positions.push_back(p);
            patch.isLocked.push_back(p.y == 0 ? 1 : 0);
        }
        patch.triangles.push_back({first, first + 1, first + 2});
    }
    EXPECT_EQ(simplifyOwn(patch, 1).triangles.size(), 2U);
}

} // namespace
} // namespace gnomon::preprocess
