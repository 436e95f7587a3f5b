// What is locked at each level, against sets, with deferred clusters too, and that cracks beside these are found.
#include "core/random.h"
#include "preprocess/pipeline/build_model.h"
#include "preprocess/verify/cracks.h"
#include "preprocess/verify/loaded_model.h"
#include "preprocess/verify/locked_edges.h"
#include "tests/support/code_mesh.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace gnomon::verify {
namespace {

using namespace hierarchy;

/// Two tests may run at once.
std::string pathOfThisTest(const std::string& name) {
    const char* test = testing::UnitTest::GetInstance()->current_test_info()->name();
    return testing::TempDir() + "gnomon_locked_edges_" + test + "_" + name;
}

/// A sheet that is all but flat, with a rough part whose clusters cost far more to coarsen.
LoadedModel modelWithDeferredClusters() {
    read::CodeMesh mesh = read::bumpySheet(120);
    Random random(3);
    for (glm::dvec3& p : mesh.positions)
        p.y = p.x < 0.3 ? random.uniform(0, 0.02) : 1e-4 * p.y;
    pipeline::BuildOptions options;
    options.output = pathOfThisTest("deferred.gnm");
    NoProgress progress;
    pipeline::buildModel(mesh, options, progress);
    return loadModel(ModelFile(options.output), progress);
}

LoadedModel tinyModel() {
    tests::TinyModelOptions options;
    options.gridExponent = 4;
    options.clusterTriangles = 32;
    options.groupClusters = 3;
    options.pageGroups = 2;
    const std::string path = pathOfThisTest("tiny.gnm");
    tests::writeModel(tests::makeTinyModel(options), path);
    NoProgress progress;
    return loadModel(ModelFile(path), progress);
}

bool isDeferred(const LoadedModel& model, const Page& page, const Cluster& cluster) {
    return model.firstLevelOf(page, cluster) < page.level;
}

using PlainEdge = std::pair<GridPoint, GridPoint>;

std::vector<PlainEdge> edgesOf(const Page& page, const Cluster& cluster) {
    std::vector<PlainEdge> edges;
    for (std::uint32_t t = 0; t < cluster.triangleCount; ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const Triangle& triangle = page.triangles[cluster.firstTriangle + t];
            const GridPoint a = page.vertices[cluster.firstVertex + triangle[k]].position;
            const GridPoint b = page.vertices[cluster.firstVertex + triangle[(k + 1) % 3]].position;
            if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
        }
    return edges;
}

/// Of each triangle at an edge of a level's surface: its page, 1 where its group is of that level, 0 where its cluster
/// is deferred, and the number of either.
using Owners = std::multiset<std::array<std::uint32_t, 3>>;

/// The owner of a cluster in the surface of `level`; nothing if it is no part of that.
std::optional<std::array<std::uint32_t, 3>> ownerAt(
    const LoadedModel& model, std::uint32_t level, std::uint32_t p, std::uint32_t group, std::uint32_t cluster) {
    const Page& page = model.pages[p];
    if (page.level < level || model.firstLevelOf(page, page.clusters[cluster]) > level) return std::nullopt;
    if (page.level == level) return std::array{p, 1U, group};
    return std::array{p, 0U, cluster};
}

std::map<PlainEdge, Owners> ownersAt(const LoadedModel& model, std::uint32_t level) {
    std::map<PlainEdge, Owners> owners;
    for (std::uint32_t p = 0; p < model.pages.size(); ++p) {
        const Page& page = model.pages[p];
        for (std::uint32_t g = 0; g < page.groups.size(); ++g)
            for (std::uint32_t i = 0; i < page.groups[g].clusterCount; ++i) {
                const std::uint32_t c = page.groups[g].firstCluster + i;
                const auto owner = ownerAt(model, level, p, g, c);
                if (!owner) continue;
                for (const PlainEdge& edge : edgesOf(page, page.clusters[c]))
                    owners[edge].insert(*owner);
            }
    }
    return owners;
}

bool isShared(const Owners& owners) {
    return *owners.begin() != *owners.rbegin();
}

using Locks = std::map<std::uint32_t, std::size_t>; // level -> triangles

std::map<PlainEdge, Locks> plainLocks(const LoadedModel& model) {
    std::map<PlainEdge, Locks> locks;
    for (std::uint32_t level = 0; level < model.summary.levels.size(); ++level)
        for (const auto& [edge, owners] : ownersAt(model, level))
            if (isShared(owners)) locks[edge][level] = owners.size();
    return locks;
}

/// Every cluster has the locked edges of its triangles, by their numbers.
void expectEdgesOfClusters(
    const LoadedModel& model, const LockedEdges& edges, const std::map<PlainEdge, std::uint32_t>& numberOf) {
    for (std::size_t p = 0; p < model.pages.size(); ++p)
        for (std::uint32_t c = 0; c < model.pages[p].clusters.size(); ++c) {
            std::multiset<std::uint32_t> locked;
            for (const PlainEdge& edge : edgesOf(model.pages[p], model.pages[p].clusters[c]))
                if (numberOf.contains(edge)) locked.insert(numberOf.at(edge));
            const auto found = edges.edgesOf(model.firstCluster[p] + c);
            ASSERT_EQ(std::multiset<std::uint32_t>(found.begin(), found.end()), locked);
        }
}

std::size_t deferredCount(const LoadedModel& model) {
    std::size_t count = 0;
    for (const Page& page : model.pages)
        for (const Cluster& cluster : page.clusters)
            count += isDeferred(model, page, cluster) ? 1 : 0;
    return count;
}

TEST(LockedEdges, AreThoseThatGroupsAndDeferredClustersOfALevelShare) {
    const std::array models = {tinyModel(), modelWithDeferredClusters()};
    EXPECT_EQ(deferredCount(models[0]), 0U);
    EXPECT_GT(deferredCount(models[1]), 20U);
    for (const LoadedModel& model : models) {
        const std::map<PlainEdge, Locks> expected = plainLocks(model);
        ASSERT_GT(expected.size(), 20U);
        const LockedEdges edges(model);
        ASSERT_EQ(edges.count(), expected.size());
        std::map<PlainEdge, std::uint32_t> numberOf;
        for (std::uint32_t e = 0; e < edges.count(); ++e) {
            const auto [first, second] = std::minmax({edges.end(e, false), edges.end(e, true)});
            Locks locks;
            for (const EdgeLock& lock : edges.locks(e))
                locks[lock.level] = lock.triangles;
            ASSERT_EQ(locks, expected.at({first, second}));
            numberOf[{first, second}] = e;
        }
        expectEdgesOfClusters(model, edges, numberOf);
    }
}

/// Moves a vertex of `cluster` that is the first end of an edge.
void moveEnd(Page& page, const Cluster& cluster, const PlainEdge& edge) {
    for (std::uint32_t v = 0; v < cluster.vertexCount; ++v) {
        GridPoint& p = page.vertices[cluster.firstVertex + v].position;
        if (p == edge.first) ++p.y;
    }
}

/// Moves what replaces a group beside a deferred cluster off their edge, where only the lock between these two can
/// tell; false if there is no such edge.
bool moveOffADeferredCluster(LoadedModel& model) {
    for (std::uint32_t level = 1; level + 1 < model.summary.levels.size(); ++level) {
        const auto owners = ownersAt(model, level);
        const auto next = ownersAt(model, level + 1);
        const auto isTheOnlyLock = [&](const PlainEdge& edge) {
            const auto found = owners.find(edge);
            if (found == owners.end() || found->second.size() != 2 || isShared(next.at(edge))) return false;
            return (*found->second.begin())[1] != (*found->second.rbegin())[1];
        };
        for (Page& page : model.pages)
            for (const Cluster& cluster : page.clusters) {
                if (page.level != level + 1 || isDeferred(model, page, cluster)) continue;
                const std::vector<PlainEdge> edges = edgesOf(page, cluster);
                const auto edge = std::ranges::find_if(edges, isTheOnlyLock);
                if (edge == edges.end()) continue;
                moveEnd(page, cluster, *edge);
                return true;
            }
    }
    return false;
}

TEST(LockedEdges, ACrackBesideADeferredClusterIsFound) {
    LoadedModel model = modelWithDeferredClusters();
    NoProgress progress;
    const Check sound = checkCracks(model, 100, 3, progress);
    EXPECT_GT(sound.tested, 1000U);
    EXPECT_EQ(sound.failed, 0U) << sound.detail;
    ASSERT_TRUE(moveOffADeferredCluster(model)) << "no such edge";
    EXPECT_GT(checkCracks(model, 200, 3, progress).failed, 0U);
}

} // namespace
} // namespace gnomon::verify
