// The levels of one part: up to the root, or as many as asked for, with what is left over.
#include "preprocess/levels/level_clusters.h"
#include "preprocess/levels/node.h"
#include "tests/levels/meshes.h"

#include <gtest/gtest.h>

namespace gnomon::levels {
namespace {

BuiltNode built(simplify::Mesh mesh, const NodePlan& plan) {
    NoProgress progress;
    Level level = firstLevel(mesh, {});
    return buildNode(mesh, std::move(level), plan, {}, progress);
}

/// Each level has fewer triangles and a larger error than the one below, and its pages tell what it has.
void expectLevelsSound(const BuiltNode& node) {
    for (std::size_t i = 0; i < node.levels.size(); ++i) {
        const NodeLevel& level = node.levels[i];
        std::uint64_t triangles = 0;
        std::uint64_t groups = 0;
        std::uint64_t clusters = 0;
        for (const hierarchy::EncodedPage& page : level.pages) {
            triangles += page.info.triangleCount;
            groups += page.info.groupCount;
            clusters += page.info.clusterCount;
        }
        EXPECT_EQ(level.info.triangles, triangles);
        EXPECT_EQ(level.info.groups, groups);
        EXPECT_EQ(level.info.clusters, clusters);
        if (i == 0) continue;
        EXPECT_LT(level.info.triangles, node.levels[i - 1].info.triangles * 6 / 10);
        EXPECT_GT(level.info.maxError, node.levels[i - 1].info.maxError);
    }
}

TEST(Node, UpToTheRootEndsInOneClusterAndLeavesNothing) {
    const simplify::Mesh mesh = meshOf(read::bumpySheet(60));
    const BuiltNode node = built(mesh, {0, hierarchy::kNone});
    expectLevelsSound(node);
    EXPECT_EQ(node.levels.front().info.triangles, mesh.triangles.size());
    EXPECT_EQ(node.levels.front().info.maxError, mesh.grid.snapError());
    EXPECT_EQ(node.levels.back().info.clusters, 1U);
    EXPECT_EQ(node.rootTriangles, node.levels.back().info.triangles);
    EXPECT_LE(node.rootTriangles, 128U);
    EXPECT_EQ(node.irreducibleTriangles, 0U);
    EXPECT_TRUE(node.pending.bytes.empty());
    EXPECT_EQ(node.pending.triangles, 0U);
}

TEST(Node, ThatIsOneClusterIsARoot) {
    const BuiltNode node = built(meshOf(read::bumpySheet(4)), {0, hierarchy::kNone});
    ASSERT_EQ(node.levels.size(), 1U);
    EXPECT_EQ(node.rootTriangles, 32U);
    EXPECT_EQ(node.irreducibleTriangles, 0U);
}

TEST(Node, OfAsManyLevelsAsAskedLeavesTheNextOnePending) {
    const simplify::Mesh mesh = meshOf(read::bumpySheet(60));
    const BuiltNode all = built(mesh, {0, hierarchy::kNone});
    for (const std::uint32_t count : {1U, 2U}) {
        const BuiltNode some = built(mesh, {0, count});
        expectLevelsSound(some);
        ASSERT_EQ(some.levels.size(), count);
        EXPECT_EQ(some.pending.triangles, all.levels[count].info.triangles);
        EXPECT_EQ(some.rootTriangles, 0U);
        EXPECT_FALSE(some.pending.bytes.empty());
    }
}

TEST(Node, OfOneClusterWaitsForItsNeighbours) {
    const BuiltNode first = built(meshOf(read::bumpySheet(4)), {0, 3});
    EXPECT_EQ(first.levels.size(), 1U); // triangles of level 0 always get into groups
    EXPECT_GT(first.pending.triangles, 0U);
    const BuiltNode later = built(meshOf(read::bumpySheet(4)), {2, 3});
    EXPECT_TRUE(later.levels.empty());
    EXPECT_EQ(later.pending.triangles, 32U);
}

TEST(Node, WhereEveryPositionIsSharedIsStuckAtTheRootOnly) {
    simplify::Mesh mesh = meshOf(read::bumpySheet(20));
    mesh.isBorder.assign(mesh.positionCount, 1);
    const BuiltNode root = built(mesh, {0, hierarchy::kNone});
    EXPECT_EQ(root.levels.size(), 1U);
    EXPECT_EQ(root.irreducibleTriangles, 800U);
    const BuiltNode inner = built(mesh, {0, 3});
    EXPECT_EQ(inner.irreducibleTriangles, 0U);
    EXPECT_EQ(inner.pending.triangles, 800U);
}

TEST(Node, OfNoTrianglesHasNoLevels) {
    const BuiltNode node = built(meshOf(read::CodeMesh({}, {})), {0, hierarchy::kNone});
    EXPECT_TRUE(node.levels.empty());
    EXPECT_EQ(node.rootTriangles, 0U);
}

} // namespace
} // namespace gnomon::levels
