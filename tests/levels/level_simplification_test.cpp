// One step to the next coarser level: what replaces each group, and what it says of its error.
#include "core/random.h"
#include "preprocess/levels/grouping.h"
#include "preprocess/levels/level_clusters.h"
#include "preprocess/levels/level_simplification.h"
#include "tests/levels/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace gnomon::levels {
namespace {

Level groupedLevel(const simplify::Mesh& mesh) {
    Level level = firstLevel(mesh, {});
    formGroups(level, mesh.grid, {}, 0, false);
    for (std::uint32_t g = 0; g < level.groups.size(); ++g)
        level.groups[g].place = {7, g / 3, g % 3};
    return level;
}

/// Counts what it is told.
class Counter final : public Progress {
public:
    void stage(std::string_view /*name*/, std::string_view /*unit*/, std::uint64_t /*total*/) override {}

    void advance(std::uint64_t count) override { sum_ += count; }

    std::uint64_t sum() const { return sum_; }

private:
    std::atomic<std::uint64_t> sum_{0};
};

TEST(SimplifiedLevel, HalvesEachGroupAndNamesItInTheClustersThatReplaceIt) {
    const simplify::Mesh mesh = meshOf(read::bumpySheet(64));
    Level level = groupedLevel(mesh);
    Counter progress;
    const Level next = simplifiedLevel(mesh, level, {}, simplify::CostLimit::None, false, progress);
    EXPECT_EQ(progress.sum(), level.triangles.size());
    EXPECT_LE(next.triangles.size(), level.triangles.size() * 11 / 20);
    EXPECT_GE(next.triangles.size(), level.triangles.size() * 2 / 5);
    ASSERT_EQ(next.refinements.size(), level.groups.size());
    EXPECT_EQ(next.errors.size(), next.triangles.size());
    std::set<std::uint32_t> named;
    std::uint32_t first = 0;
    for (const LevelCluster& cluster : next.clusters) {
        ASSERT_EQ(cluster.firstTriangle, first);
        first += cluster.triangleCount;
        named.insert(cluster.refinement);
        const hierarchy::GridBox& outer = level.groups[cluster.refinement].box;
        for (const Corners& corners : cornersOf(mesh, next, cluster.firstTriangle, cluster.triangleCount))
            for (const hierarchy::GridPoint& p : corners)
                ASSERT_TRUE(p.x >= outer.min.x && p.x <= outer.max.x && p.z >= outer.min.z && p.z <= outer.max.z);
    }
    EXPECT_EQ(first, next.triangles.size());
    EXPECT_EQ(named.size(), level.groups.size());
    for (std::uint32_t g = 0; g < level.groups.size(); ++g) {
        EXPECT_EQ(next.refinements[g].place.page, g / 3);
        EXPECT_EQ(next.refinements[g].place.group, g % 3);
        EXPECT_EQ(next.refinements[g].error, level.groups[g].error);
        EXPECT_EQ(next.refinements[g].bounds.radius, level.groups[g].bounds.radius);
    }
}

TEST(SimplifiedLevel, WhereNothingHindersAGroupHasHalfItsTrianglesLeftRoundedUp) {
    read::CodeMesh flat = read::bumpySheet(40);
    for (glm::dvec3& p : flat.positions)
        p.y = 0;
    const simplify::Mesh mesh = meshOf(flat);
    NoProgress progress;
    Level level = groupedLevel(mesh);
    const Level next = simplifiedLevel(mesh, level, {}, simplify::CostLimit::None, false, progress);
    std::vector<std::size_t> before(level.groups.size(), 0);
    for (const std::uint32_t group : groupOfTriangles(level))
        ++before[group];
    std::vector<std::size_t> after(level.groups.size(), 0);
    for (const LevelCluster& cluster : next.clusters)
        after[cluster.refinement] += cluster.triangleCount;
    for (std::size_t g = 0; g < before.size(); ++g) {
        EXPECT_LE(after[g], (before[g] + 1) / 2) << "of " << before[g];
        EXPECT_GE(after[g] + 1, before[g] / 2) << "a collapse takes two at most";
    }
}

TEST(SimplifiedLevel, AGroupsErrorIsThatOfItsWorstTriangleAndTheGridsAndNeverLessThanBefore) {
    const simplify::Mesh mesh = meshOf(read::bumpySheet(64));
    NoProgress progress;
    for (const simplify::Simplifier simplifier :
         {simplify::Simplifier::Quadric, simplify::Simplifier::Meshopt, simplify::Simplifier::OpenMesh}) {
        LevelOptions options;
        options.simplifier = simplifier;
        Level level = groupedLevel(mesh);
        const double before = 5 * mesh.grid.step();
        level.refinements.push_back({{}, {}, before});
        level.clusters[level.groups[1].firstCluster].refinement = 0;
        const Level next = simplifiedLevel(mesh, level, options, simplify::CostLimit::None, false, progress);
        std::vector<double> worst(level.groups.size(), 0);
        for (const LevelCluster& cluster : next.clusters)
            for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t)
                worst[cluster.refinement] = std::max(
                    {worst[cluster.refinement], double{next.errors[t].fromSource}, double{next.errors[t].toSource}});
        for (std::size_t g = 0; g < worst.size(); ++g) {
            double expected = worst[g] * mesh.grid.step() + mesh.grid.snapError();
            if (g == 1) expected = std::max(expected, before);
            EXPECT_GE(level.groups[g].error, expected);
            EXPECT_LE(level.groups[g].error, expected * (1 + 1e-8));
        }
    }
}

TEST(SimplifiedLevel, AnEstimatedErrorIsTheOneBeforeAndTheSimplifiersClaim) {
    const simplify::Mesh mesh = meshOf(read::bumpySheet(40));
    NoProgress progress;
    LevelOptions options;
    options.error = ErrorKind::Estimated;
    Level level = groupedLevel(mesh);
    const Level next = simplifiedLevel(mesh, level, options, simplify::CostLimit::None, false, progress);
    Level measured = groupedLevel(mesh);
    simplifiedLevel(mesh, measured, {}, simplify::CostLimit::None, false, progress);
    for (const simplify::TriangleError& error : next.errors)
        ASSERT_EQ(std::max(error.fromSource, error.toSource), 0);
    for (std::size_t g = 0; g < level.groups.size(); ++g) {
        EXPECT_GT(level.groups[g].error, mesh.grid.snapError());
        EXPECT_LT(level.groups[g].error, measured.groups[g].error * 2);
    }
}

TEST(SimplifiedLevel, ATightErrorIsNowhereMoreThanAMeasuredOneAndLowerBefore) {
    const simplify::Mesh mesh = meshOf(read::bumpySheet(64));
    NoProgress progress;
    LevelOptions options;
    options.error = ErrorKind::Tight;
    Level tight = groupedLevel(mesh);
    const Level next = simplifiedLevel(mesh, tight, options, simplify::CostLimit::None, false, progress);
    Level measured = groupedLevel(mesh);
    const Level other = simplifiedLevel(mesh, measured, {}, simplify::CostLimit::None, false, progress);
    EXPECT_EQ(next.triangles, other.triangles) << "of the source's own level the same triangles are left";
    double sum = 0;
    double measuredSum = 0;
    for (std::size_t g = 0; g < tight.groups.size(); ++g) {
        EXPECT_LE(tight.groups[g].error, measured.groups[g].error);
        EXPECT_GT(tight.groups[g].error, mesh.grid.snapError());
        sum += tight.groups[g].error;
        measuredSum += measured.groups[g].error;
    }
    EXPECT_LT(sum, 0.9 * measuredSum);
}

TEST(SimplifiedLevel, KeepsThePositionsThatGroupsShare) {
    const simplify::Mesh mesh = meshOf(read::bumpySheet(64));
    Level level = groupedLevel(mesh);
    const std::vector<std::uint32_t> groups = groupOfTriangles(level);
    std::vector<std::set<std::uint32_t>> users(mesh.positionCount);
    for (std::size_t t = 0; t < groups.size(); ++t)
        for (const std::uint32_t v : level.triangles[t])
            users[v].insert(groups[t]);
    NoProgress progress;
    const Level next = simplifiedLevel(mesh, level, {}, simplify::CostLimit::None, false, progress);
    std::set<std::uint32_t> left;
    for (const simplify::Triangle& t : next.triangles)
        left.insert(t.begin(), t.end());
    for (std::uint32_t v = 0; v < users.size(); ++v)
        ASSERT_TRUE(users[v].size() <= 1 || left.contains(v)) << v;
}

/// Level 1 of `mesh`, in groups.
Level levelAboveTheFirst(const simplify::Mesh& mesh) {
    Level finest = groupedLevel(mesh);
    NoProgress progress;
    Level level = simplifiedLevel(mesh, finest, {}, simplify::CostLimit::MeanEdge, false, progress);
    formGroups(level, mesh.grid, {}, 1, false);
    return level;
}

TEST(SimplifiedLevel, DefersGroupsThatCostFarMoreThanOthers) {
    read::CodeMesh sheet = read::bumpySheet(200);
    Random random(4);
    for (glm::dvec3& p : sheet.positions)
        p.y = p.x < 0.12 ? random.uniform(0, 0.2) : 0.1 * p.y;
    const simplify::Mesh mesh = meshOf(sheet);
    Counter progress;
    Level all = levelAboveTheFirst(mesh);
    Level some = all;
    simplifiedLevel(mesh, all, {}, simplify::CostLimit::MeanEdge, false, progress);
    const Level next = simplifiedLevel(mesh, some, {}, simplify::CostLimit::MeanEdge, true, progress);
    EXPECT_EQ(progress.sum(), 2 * some.triangles.size());
    std::vector<double> errors; // of each triangle, were all groups simplified
    const std::vector<std::uint32_t> groups = groupOfTriangles(all);
    errors.reserve(groups.size());
    for (const std::uint32_t g : groups)
        errors.push_back(all.groups[g].error);
    std::sort(errors.begin(), errors.end());
    const double limit = 4 * errors[(errors.size() + 1) / 2 - 1];
    std::size_t deferred = 0;
    std::size_t kept = 0;
    for (std::size_t g = 0; g < some.groups.size(); ++g) {
        double before = 0;
        for (std::uint32_t c = 0; c < some.groups[g].clusterCount; ++c)
            before =
                std::max(before, some.refinements[some.clusters[some.groups[g].firstCluster + c].refinement].error);
        ASSERT_EQ(some.groups[g].isDeferred, all.groups[g].error > std::max(limit, before));
        if (some.groups[g].isDeferred) {
            ++deferred;
            continue;
        }
        EXPECT_EQ(some.groups[g].error, all.groups[g].error);
        EXPECT_EQ(next.refinements[kept].error, some.groups[g].error);
        ++kept;
    }
    EXPECT_GT(deferred, 0U);
    EXPECT_GT(kept, deferred);
    Level passedOn;
    for (const LevelGroup& group : some.groups)
        for (std::uint32_t c = 0; c < (group.isDeferred ? group.clusterCount : 0); ++c) {
            const LevelCluster& cluster = some.clusters[group.firstCluster + c];
            for (std::uint32_t t = 0; t < cluster.triangleCount; ++t)
                passedOn.triangles.push_back(some.triangles[cluster.firstTriangle + t]);
        }
    const std::size_t count = passedOn.triangles.size();
    EXPECT_EQ(cornersOf(mesh, next, next.triangles.size() - count, count), cornersOf(mesh, passedOn));
}

} // namespace
} // namespace gnomon::levels
