#include "core/box.h"
#include "preprocess/make/plant.h"
#include "tests/make/made_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::make {
namespace {

constexpr std::uint64_t kSeed = 1;

/// What the plant promises about its parts; `mesh` with or without equal positions welded.
void expectManyOpenDoubledParts(const MadeMesh& mesh, double doubledShare) {
    const auto triangles = static_cast<double>(mesh.triangles.size());
    EXPECT_GE(static_cast<double>(componentCount(mesh)), 5'000 * triangles / 1e6);
    const auto uses = edgeUses(mesh);
    const auto open = std::count_if(
        uses.begin(), uses.end(), [](const auto& entry) { return entry.second.upwards + entry.second.downwards == 1; });
    EXPECT_GE(static_cast<double>(open), 0.05 * static_cast<double>(uses.size()));
    EXPECT_GE(static_cast<double>(doubledCount(mesh)), doubledShare * triangles);
}

/// Vertices that lie inside one of the `count` longest open edges.
std::uint64_t vertexOnEdgeCount(const MadeMesh& mesh, std::size_t count) {
    std::vector<std::pair<double, std::pair<std::uint64_t, std::uint64_t>>> open;
    for (const auto& [edge, use] : edgeUses(mesh))
        if (use.upwards + use.downwards == 1)
            open.emplace_back(
                static_cast<double>(glm::distance(mesh.vertices[edge.first], mesh.vertices[edge.second])), edge);
    std::sort(open.rbegin(), open.rend());
    open.resize(std::min(open.size(), count));
    std::uint64_t found = 0;
    for (const auto& [length, edge] : open) {
        const glm::dvec3 a(mesh.vertices[edge.first]);
        const glm::dvec3 along = (glm::dvec3(mesh.vertices[edge.second]) - a) / length;
        for (const glm::vec3& vertex : mesh.vertices) {
            const glm::dvec3 offset = glm::dvec3(vertex) - a;
            const double t = glm::dot(offset, along);
            if (t > 0.01 * length && t < 0.99 * length && glm::length(offset - t * along) < 1e-4) ++found;
        }
    }
    return found;
}

TEST(Plant, HasTheTrianglesAskedForWithinTwoPercent) {
    for (const std::uint64_t wanted :
         {20'000ULL, 50'001ULL, 300'000ULL, 1'000'000ULL, 13'000'000ULL, 2'000'000'000ULL}) {
        const auto got = static_cast<double>(modelSize(Plant(wanted, kSeed)).triangles);
        EXPECT_NEAR(got, static_cast<double>(wanted), 0.02 * static_cast<double>(wanted));
    }
}

TEST(Plant, IsMadeOfManyOpenDoubledUnweldedParts) {
    for (const std::uint64_t triangles : {20'000ULL, 300'000ULL}) {
        const MadeMesh mesh = collect(Plant(triangles, kSeed));
        const MadeMesh weld = welded(mesh);
        expectManyOpenDoubledParts(mesh, 0);
        expectManyOpenDoubledParts(weld, 0.005);
        EXPECT_LT(weld.vertices.size(), mesh.vertices.size() * 98 / 100);
    }
}

TEST(SlowPlant, IsMadeOfManyOpenDoubledPartsAtAMillionAndMore) {
    for (const std::uint64_t triangles : {1'000'000ULL, 6'000'000ULL})
        expectManyOpenDoubledParts(welded(collect(Plant(triangles, kSeed))), 0.005);
}

TEST(Plant, HasSliversAndTJunctionsButNoDegenerateTriangle) {
    const MadeMesh mesh = welded(collect(Plant(60'000, kSeed)));
    std::uint64_t slivers = 0;
    for (const MadeTriangle& t : mesh.triangles) {
        double longest = 0;
        for (std::size_t i = 0; i < 3; ++i)
            longest = std::max(
                longest, static_cast<double>(glm::distance(mesh.vertices[t.at(i)], mesh.vertices[t.at((i + 1) % 3)])));
        ASSERT_GT(area(mesh, t), 0);
        if (2 * area(mesh, t) / longest < longest / 100) ++slivers;
    }
    EXPECT_GT(slivers, mesh.triangles.size() / 100);
    EXPECT_GT(vertexOnEdgeCount(mesh, 60), 20U);
}

TEST(Plant, IsWideAndYetFine) {
    const MadeMesh mesh = collect(Plant(300'000, kSeed));
    Box box;
    for (const glm::vec3& vertex : mesh.vertices)
        box.add(glm::dvec3(vertex));
    EXPECT_GE(box.extent().x, 400);
    EXPECT_GE(box.extent().z, 400);
    EXPECT_GE(box.extent().y, 100);
    EXPECT_GE(box.min.y, -0.5);
    std::vector<float> edges;
    for (const MadeTriangle& t : mesh.triangles)
        edges.push_back(glm::distance(mesh.vertices[t[0]], mesh.vertices[t[1]]));
    std::nth_element(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 4), edges.end());
    EXPECT_LT(edges[edges.size() / 4], 0.2F); // metres: what stands before the eye is finer than what closes the view
}

TEST(Plant, GrowsInPartsAndInRoundness) {
    const MadeMesh small = collect(Plant(300'000, kSeed));
    const MadeMesh large = collect(Plant(1'200'000, kSeed));
    EXPECT_GT(componentCount(large), 2 * componentCount(small));
    EXPECT_LT(meanEdge(large), 0.9 * meanEdge(small));
}

} // namespace
} // namespace gnomon::make
