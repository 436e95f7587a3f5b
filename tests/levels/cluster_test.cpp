// Clusters hold every triangle once, within their limits, and leave small parts whole.
#include "core/random.h"
#include "preprocess/levels/cluster.h"
#include "tests/support/code_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace gnomon::levels {
namespace {

struct Source {
    explicit Source(const read::CodeMesh& mesh) : triangles(mesh.triangles) {
        for (const glm::dvec3& p : mesh.positions) {
            positionOf.push_back(static_cast<std::uint32_t>(positions.size()));
            positions.emplace_back(p);
        }
    }

    Clustering cut(std::uint32_t maxTriangles) const {
        return clusterTriangles(triangles, positionOf, positions, maxTriangles);
    }

    std::vector<simplify::Triangle> triangles;
    std::vector<std::uint32_t> positionOf;
    std::vector<glm::vec3> positions;
};

/// Each triangle once; within the limits; vertices counted right.
void expectSound(const Source& source, const Clustering& clustering, std::uint32_t maxTriangles) {
    std::vector<std::uint32_t> order = clustering.order;
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> all(source.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    ASSERT_EQ(order, all);
    ASSERT_EQ(clustering.ends.size(), clustering.vertexCounts.size());
    ASSERT_EQ(clustering.ends.back(), all.size());
    std::uint32_t begin = 0;
    for (std::size_t c = 0; c < clustering.ends.size(); ++c) {
        std::set<std::uint32_t> vertices;
        for (std::uint32_t i = begin; i < clustering.ends[c]; ++i)
            for (const std::uint32_t v : source.triangles[clustering.order[i]])
                vertices.insert(v);
        ASSERT_GT(clustering.ends[c], begin);
        ASSERT_LE(clustering.ends[c] - begin, maxTriangles);
        ASSERT_EQ(clustering.vertexCounts[c], vertices.size());
        ASSERT_LE(vertices.size(), kMaxClusterVertices);
        begin = clustering.ends[c];
    }
}

TEST(Clusters, HoldEveryTriangleOnceWithinTheirLimits) {
    for (const read::CodeMesh& mesh : {read::bumpySheet(30), read::strewnBoxes(150)})
        for (const std::uint32_t max : {1U, 12U, 64U, 128U}) {
            const Source source(mesh);
            expectSound(source, source.cut(max), max);
        }
}

TEST(Clusters, OfASheetAreMostlyFull) {
    const Source source(read::bumpySheet(32));
    const Clustering clustering = source.cut(128);
    EXPECT_EQ(clustering.ends.size(), source.triangles.size() / 128);
}

TEST(Clusters, LeaveSmallPartsWhole) {
    const Source source(read::strewnBoxes(150)); // of 12 triangles each, one after the other
    const Clustering clustering = source.cut(30);
    std::vector<std::size_t> clusterOf(source.triangles.size());
    std::size_t cluster = 0;
    for (std::uint32_t i = 0; i < clustering.order.size(); ++i) {
        if (i == clustering.ends[cluster]) ++cluster;
        clusterOf[clustering.order[i]] = cluster;
    }
    for (std::size_t t = 0; t < clusterOf.size(); ++t)
        ASSERT_EQ(clusterOf[t], clusterOf[t - t % 12]);
    EXPECT_LE(clustering.ends.size(), 150U); // and join others
    EXPECT_LT(source.cut(128).ends.size(), 25U);
}

TEST(Clusters, OfTrianglesThatShareNothingAreHalvedUntilTheirVerticesFit) {
    Random random(3);
    std::vector<glm::dvec3> positions;
    std::vector<simplify::Triangle> triangles;
    for (std::uint32_t t = 0; t < 500; ++t) {
        for (int corner = 0; corner < 3; ++corner) {
            const double x = random.unit();
            const double y = random.unit();
            positions.emplace_back(x, y, random.unit());
        }
        triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    const Source source(read::CodeMesh(std::move(positions), std::move(triangles)));
    const Clustering clustering = source.cut(128);
    expectSound(source, clustering, 85);
    EXPECT_LE(clustering.ends.size(), 8U);
}

TEST(Clusters, SmallPartsAreKnownByPositionsAndVerticesByThemselves) {
    // Two triangles on one edge that share positions, but no vertices: one part of six vertices.
    const std::vector<simplify::Triangle> triangles{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
    const std::vector<std::uint32_t> positionOf{0, 1, 2, 1, 0, 3, 4, 5, 6};
    const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 0}, {2, 0, 0}, {3, 0, 0}, {2, 1, 0}};
    const Clustering clustering = clusterTriangles(triangles, positionOf, positions, 2);
    ASSERT_EQ(clustering.ends.size(), 2U);
    std::set<std::set<std::uint32_t>> clusters;
    std::uint32_t begin = 0;
    for (std::size_t c = 0; c < 2; ++c) {
        clusters.emplace(clustering.order.begin() + begin, clustering.order.begin() + clustering.ends[c]);
        EXPECT_EQ(clustering.vertexCounts[c], 3 * (clustering.ends[c] - begin));
        begin = clustering.ends[c];
    }
    EXPECT_EQ(clusters, (std::set<std::set<std::uint32_t>>{{0, 1}, {2}}));
}

} // namespace
} // namespace gnomon::levels
