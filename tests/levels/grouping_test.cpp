// Groups take their clusters along whole, their bounds enclose what they must, and no more.
#include "core/random.h"
#include "preprocess/levels/grouping.h"
#include "preprocess/levels/level_clusters.h"
#include "tests/levels/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace gnomon::levels {
namespace {

bool encloses(const Sphere& outer, const Sphere& inner) {
    return glm::length(outer.center - inner.center) + inner.radius <= outer.radius * (1 + 1e-15);
}

/// The first level of a sheet whose clusters come from groups of a finer one, with bounds of all sizes.
Level levelWithRefinements(const simplify::Mesh& mesh) {
    Level level = firstLevel(mesh, {});
    for (std::uint32_t c = 0; c < level.clusters.size(); ++c) {
        const Box box = mesh.grid.local(level.clusters[c].box);
        level.refinements.push_back(
            {{0, 0, c}, {box.center(), glm::length(box.extent()) * (0.3 + 0.1 * (c % 9))}, 0.25});
        if (c % 4 != 0) level.clusters[c].refinement = c;
    }
    return level;
}

TEST(FirstLevel, HasTheTrianglesOfTheMeshInClustersThatFit) {
    const simplify::Mesh mesh = meshOf(read::bumpySheet(40));
    LevelOptions options;
    options.clusterTriangles = 50;
    const Level level = firstLevel(mesh, options);
    Level all;
    all.triangles = mesh.triangles;
    EXPECT_EQ(cornersOf(mesh, level), cornersOf(mesh, all));
    EXPECT_EQ(level.errors.size(), level.triangles.size());
    EXPECT_TRUE(level.groups.empty());
    std::uint32_t next = 0;
    for (const LevelCluster& cluster : level.clusters) {
        ASSERT_EQ(cluster.firstTriangle, next);
        ASSERT_LE(cluster.triangleCount, options.clusterTriangles);
        next += cluster.triangleCount;
        hierarchy::GridBox box;
        for (const Corners& corners : cornersOf(mesh, level, cluster.firstTriangle, cluster.triangleCount))
            for (const hierarchy::GridPoint& p : corners)
                box.add(p);
        ASSERT_EQ(cluster.box.min, box.min);
        ASSERT_EQ(cluster.box.max, box.max);
        ASSERT_EQ(cluster.refinement, hierarchy::kNone);
    }
    EXPECT_EQ(next, level.triangles.size());
}

TEST(FormGroups, PutsEveryClusterWithItsTrianglesAndErrorsIntoOneGroup) {
    const simplify::Mesh mesh = meshOf(read::bumpySheet(70));
    for (const std::uint32_t number : {0U, 1U, 2U, 3U}) {
        Level level = levelWithRefinements(mesh);
        std::map<std::vector<Corners>, std::pair<std::uint32_t, float>> clusters; // its refinement and first error
        for (std::uint32_t t = 0; t < level.errors.size(); ++t)
            level.errors[t].fromSource = static_cast<float>(t);
        for (const LevelCluster& c : level.clusters)
            clusters[cornersOf(mesh, level, c.firstTriangle, c.triangleCount)] = {
                c.refinement, level.errors[c.firstTriangle].fromSource};
        formGroups(level, mesh.grid, {}, number, false);
        EXPECT_EQ(level.clusters.size(), clusters.size());
        EXPECT_EQ(level.refinements.size(), clusters.size());
        std::uint32_t nextCluster = 0;
        std::uint32_t nextTriangle = 0;
        for (const LevelGroup& group : level.groups) {
            ASSERT_EQ(group.firstCluster, nextCluster);
            nextCluster += group.clusterCount;
            std::uint32_t triangles = 0;
            for (std::uint32_t c = group.firstCluster; c < nextCluster; ++c) {
                const LevelCluster& cluster = level.clusters[c];
                ASSERT_EQ(cluster.firstTriangle, nextTriangle);
                nextTriangle += cluster.triangleCount;
                triangles += cluster.triangleCount;
                const auto found =
                    clusters.extract(cornersOf(mesh, level, cluster.firstTriangle, cluster.triangleCount));
                ASSERT_FALSE(found.empty());
                ASSERT_EQ(cluster.refinement, found.mapped().first);
                ASSERT_EQ(level.errors[cluster.firstTriangle].fromSource, found.mapped().second);
            }
            ASSERT_LE(triangles, 16U * 128U);
            ASSERT_EQ(group.error, std::numeric_limits<double>::infinity());
        }
        EXPECT_EQ(nextCluster, level.clusters.size());
        EXPECT_LE(level.groups.size(), 2 * mesh.triangles.size() / (std::size_t{16} * 128));
    }
}

TEST(FormGroups, BoundsEncloseTheBoxAndTheFinerGroupsAndHardlyMore) {
    const simplify::Mesh mesh = meshOf(read::bumpySheet(70));
    Level level = levelWithRefinements(mesh);
    formGroups(level, mesh.grid, {}, 0, false);
    for (const LevelGroup& group : level.groups) {
        hierarchy::GridBox box;
        double needed = 0;
        for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
            box.add(level.clusters[c].box);
            if (level.clusters[c].refinement == hierarchy::kNone) continue;
            const Sphere& finer = level.refinements[level.clusters[c].refinement].bounds;
            ASSERT_TRUE(encloses(group.bounds, finer));
            needed = std::max(needed, glm::length(finer.center - group.bounds.center) + finer.radius);
        }
        ASSERT_EQ(group.box.min, box.min);
        ASSERT_EQ(group.box.max, box.max);
        const Box local = mesh.grid.local(box);
        for (const glm::dvec3& corner : {local.min, local.max}) {
            ASSERT_TRUE(encloses(group.bounds, {corner, 0}));
            needed = std::max(needed, glm::length(corner - group.bounds.center));
        }
        ASSERT_LE(group.bounds.radius, needed * (1 + 1e-9));
    }
}

TEST(FormGroups, CutsElsewhereThanInTheLevelBefore) {
    const simplify::Mesh mesh = meshOf(read::bumpySheet(110));
    std::vector<std::vector<std::uint64_t>> groups;
    for (const std::uint32_t number : {0U, 1U, 2U, 3U}) {
        Level level = firstLevel(mesh, {});
        formGroups(level, mesh.grid, {}, number, false);
        std::vector<std::uint64_t>& sizes = groups.emplace_back();
        for (const LevelGroup& group : level.groups)
            sizes.push_back(std::uint64_t{group.box.max.x} << 32U | group.box.max.z);
        std::sort(sizes.begin(), sizes.end());
    }
    EXPECT_NE(groups[0], groups[1]);
    EXPECT_NE(groups[1], groups[2]);
    EXPECT_NE(groups[2], groups[3]);
    EXPECT_EQ(groups[3], groups[0]);
}

/// A level all of whose clusters refine into groups of errors of either kind.
Level levelWithErrors(const simplify::Mesh& mesh, std::uint64_t seed) {
    Random random(seed);
    Level level = firstLevel(mesh, {});
    for (std::uint32_t c = 0; c < level.clusters.size(); ++c) {
        const double error = std::exp2(random.uniform(-3, 3));
        const bool isOfAttributes = random.below(2) == 0;
        level.refinements.push_back({{0, 0, c / 2}, {}, isOfAttributes ? 0.01 : error, isOfAttributes ? error : 0});
        level.clusters[c].refinement = c;
    }
    return level;
}

double errorOf(const Level& level, const LevelCluster& cluster) {
    const LevelRefinement& finer = level.refinements[cluster.refinement];
    return std::max(finer.error, finer.attributeError);
}

TEST(FormGroups, DefersClustersOfMoreThanTwiceTheUsualErrorEachByItself) {
    const simplify::Mesh mesh = meshOf(read::bumpySheet(90));
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
        const Level given = levelWithErrors(mesh, seed);
        std::vector<double> errors; // of each triangle
        for (const LevelCluster& cluster : given.clusters)
            errors.insert(errors.end(), cluster.triangleCount, errorOf(given, cluster));
        std::sort(errors.begin(), errors.end());
        const double limit = 2 * errors[(errors.size() * 2 + 2) / 3 - 1];
        Level others = given;
        std::erase_if(others.clusters, [&](const LevelCluster& c) { return errorOf(given, c) > limit; });
        ASSERT_LT(others.clusters.size(), given.clusters.size());
        Level level = given;
        formGroups(level, mesh.grid, {}, 1, true);
        formGroups(others, mesh.grid, {}, 1, false);
        ASSERT_EQ(level.groups.size(), others.groups.size() + given.clusters.size() - others.clusters.size());
        for (std::size_t g = 0; g < level.groups.size(); ++g) {
            const LevelGroup& group = level.groups[g];
            const LevelCluster& first = level.clusters[group.firstCluster];
            ASSERT_EQ(group.isDeferred, g >= others.groups.size());
            if (group.isDeferred) {
                ASSERT_EQ(group.clusterCount, 1U);
                ASSERT_GT(errorOf(level, first), limit);
                continue;
            }
            ASSERT_EQ(group.clusterCount, others.groups[g].clusterCount);
            ASSERT_EQ(group.bounds.center, others.groups[g].bounds.center);
            for (std::uint32_t c = 0; c < group.clusterCount; ++c)
                ASSERT_EQ(
                    level.clusters[group.firstCluster + c].refinement,
                    others.clusters[others.groups[g].firstCluster + c].refinement);
        }
    }
}

TEST(Deferred, ClustersGoOnToTheNextLevelAndAreGoneFromThisOne) {
    const simplify::Mesh mesh = meshOf(read::bumpySheet(70));
    Level level = levelWithErrors(mesh, 5);
    for (std::uint32_t t = 0; t < level.errors.size(); ++t)
        level.errors[t].toSource = static_cast<float>(t);
    formGroups(level, mesh.grid, {}, 1, true);
    level.groups[1].isDeferred = true; // as a group is that cannot be halved
    Level next;
    next.triangles.resize(5);
    next.errors.resize(5);
    next.refinements.resize(2);
    appendDeferred(level, next);
    Level rest = level;
    dropDeferred(rest);
    // Each cluster by what it is: triangles, the first one's error, and what it refines into.
    using What = std::tuple<std::vector<Corners>, float, double>;
    const auto contents = [&](const Level& of, bool isDeferred, const Level& where) {
        std::multiset<What> all;
        for (const LevelGroup& group : of.groups)
            for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c)
                if (const LevelCluster& cluster = of.clusters[c]; group.isDeferred == isDeferred)
                    all.insert(
                        {cornersOf(mesh, where, cluster.firstTriangle, cluster.triangleCount),
                         where.errors[cluster.firstTriangle].toSource,
                         errorOf(of, cluster)});
        return all;
    };
    EXPECT_EQ(contents(rest, false, rest), contents(level, false, level));
    EXPECT_TRUE(contents(rest, true, rest).empty());
    EXPECT_EQ(rest.refinements.size(), level.refinements.size());
    std::multiset<What> passedOn;
    for (const LevelCluster& cluster : next.clusters) {
        ASSERT_GE(cluster.refinement, 2U);
        passedOn.insert(
            {cornersOf(mesh, next, cluster.firstTriangle, cluster.triangleCount),
             next.errors[cluster.firstTriangle].toSource,
             errorOf(next, cluster)});
    }
    EXPECT_EQ(passedOn, contents(level, true, level));
    EXPECT_EQ(next.triangles.size() - 5 + rest.triangles.size(), level.triangles.size());
}

TEST(ErrorQuantile, IsThatOfTheTrianglesInTheirOrder) {
    Random random(9);
    EXPECT_EQ(errorQuantile({}, 0.5), std::numeric_limits<double>::infinity());
    for (int i = 0; i < 200; ++i) {
        std::vector<WeightedError> errors(1 + random.below(20));
        std::vector<double> all;
        for (WeightedError& error : errors) {
            error = {random.unit(), 1 + random.below(9)};
            all.insert(all.end(), error.triangles, error.error);
        }
        std::sort(all.begin(), all.end());
        const double share = random.unit();
        const auto count = static_cast<std::size_t>(std::ceil(share * static_cast<double>(all.size())));
        EXPECT_EQ(errorQuantile(errors, share), all[std::max<std::size_t>(count, 1) - 1]);
    }
}

} // namespace
} // namespace gnomon::levels
