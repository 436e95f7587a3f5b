// Patches of groups: their geometry to the bit, and locks wherever anything else has the position.
#include "preprocess/levels/group_patch.h"
#include "preprocess/levels/grouping.h"
#include "preprocess/levels/level_clusters.h"
#include "tests/levels/meshes.h"

#include <gtest/gtest.h>

#include <set>

namespace gnomon::levels {
namespace {

/// A level of several groups, some of whose positions are used outside the mesh.
struct Grouped {
    Grouped() : mesh(meshOf(read::bumpySheet(50))) {
        for (std::uint32_t p = 0; p < mesh.positionCount; p += 13)
            mesh.isBorder[p] = 1;
        level = firstLevel(mesh, {});
        formGroups(level, mesh.grid, {}, 0, false);
    }

    simplify::Mesh mesh;
    Level level;
};

TEST(PositionOwners, SharedIsWhatTwoGroupsOrOthersOutsideHave) {
    const Grouped grouped;
    const PositionOwners owners(grouped.mesh, grouped.level);
    const std::vector<std::uint32_t> groups = groupOfTriangles(grouped.level);
    std::vector<std::set<std::uint32_t>> users(grouped.mesh.positionCount);
    for (std::size_t t = 0; t < groups.size(); ++t)
        for (const std::uint32_t v : grouped.level.triangles[t])
            users[grouped.mesh.positionOf[v]].insert(groups[t]);
    std::size_t shared = 0;
    for (std::uint32_t p = 0; p < grouped.mesh.positionCount; ++p) {
        const bool expected = users[p].size() > 1 || p % 13 == 0;
        ASSERT_EQ(owners.isShared(p), expected) << p;
        shared += expected ? 1 : 0;
    }
    EXPECT_GT(shared, grouped.mesh.positionCount / 13);
    EXPECT_LT(shared, grouped.mesh.positionCount / 3);
}

TEST(GroupPatch, IsTheGroupInNumbersOfItsOwn) {
    const Grouped grouped;
    const PositionOwners owners(grouped.mesh, grouped.level);
    PatchNumbers numbers(grouped.mesh);
    const std::vector<std::uint32_t> groups = groupOfTriangles(grouped.level);
    std::size_t first = 0;
    for (std::uint32_t g = 0; g < grouped.level.groups.size(); ++g) {
        std::size_t count = 0;
        while (first + count < groups.size() && groups[first + count] == g)
            ++count;
        const auto triangles = std::span(grouped.level.triangles).subspan(first, count);
        const GroupPatch made = makeGroupPatch(grouped.mesh, triangles, owners, numbers);
        first += count;
        ASSERT_EQ(made.patch.triangles.size(), count);
        const std::set<std::uint32_t> different(made.globalVertex.begin(), made.globalVertex.end());
        ASSERT_EQ(different.size(), made.globalVertex.size());
        const glm::dvec3 origin = made.patch.positions[0];
        const hierarchy::GridPoint& start = grouped.mesh.vertices[made.globalVertex[0]].position;
        for (std::size_t t = 0; t < count; ++t)
            for (std::size_t i = 0; i < 3; ++i)
                ASSERT_EQ(made.globalVertex[made.patch.triangles[t][i]], triangles[t][i]);
        for (std::uint32_t v = 0; v < made.globalVertex.size(); ++v) {
            const std::uint32_t global = made.globalVertex[v];
            ASSERT_EQ(made.patch.vertices[v], grouped.mesh.vertices[global]);
            const std::uint32_t p = made.patch.positionOf[v];
            const hierarchy::GridPoint& at = grouped.mesh.vertices[global].position;
            const glm::dvec3 offset = glm::dvec3(at.x, at.y, at.z) - glm::dvec3(start.x, start.y, start.z);
            ASSERT_EQ(made.patch.positions[p] - origin, offset);
            ASSERT_EQ(made.patch.isLocked[p] != 0, owners.isShared(grouped.mesh.positionOf[global]));
        }
        ASSERT_EQ(origin, glm::dvec3(0));
    }
    EXPECT_EQ(first, groups.size());
}

} // namespace
} // namespace gnomon::levels
