// Pending levels as bytes and back, and neighbours that become one.
#include "preprocess/levels/level_clusters.h"
#include "preprocess/levels/pending_level.h"
#include "tests/levels/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace gnomon::levels {
namespace {

/// A sheet in clusters with errors and refinements of level 4, as the chunks [first, last] would leave it.
struct Part {
    Part(const read::CodeMesh& source, simplify::ChunkSpan chunks) : mesh(meshOf(source)), level(firstLevel(mesh, {})) {
        mesh.chunks = chunks;
        mesh.sharers.assign(mesh.positionCount, chunks);
        for (std::uint32_t t = 0; t < level.errors.size(); ++t)
            level.errors[t] = {0.5F * static_cast<float>(t), 0.25F * static_cast<float>(t)};
        for (std::uint32_t c = 0; c < level.clusters.size(); ++c) {
            level.refinements.push_back({{4, c, c + 1}, {glm::dvec3(c, 2, 3), 10.0 + c}, 20.0 + c, 30.0 + c});
            if (c % 5 != 0) level.clusters[c].refinement = c;
        }
    }

    EncodedPendingLevel encoded() const { return encodePendingLevel(mesh, level); }

    simplify::Mesh mesh;
    Level level;
};

PendingLevel merged(std::span<const Part* const> parts, std::span<const std::uint32_t> firstPages) {
    std::size_t vertices = 0;
    for (const Part* part : parts)
        vertices += part->mesh.vertices.size();
    PendingLevelMerger merger(parts[0]->mesh.grid, vertices);
    for (std::size_t i = 0; i < parts.size(); ++i)
        merger.add(parts[i]->encoded().bytes, 4, firstPages.subspan(i, 1));
    return merger.take();
}

TEST(PendingLevel, ComesBackFromItsBytes) {
    Part part(read::bumpySheet(30), {2, 3});
    for (std::uint32_t p = 0; p < part.mesh.positionCount; p += 7)
        part.mesh.sharers[p] = {1, static_cast<std::uint16_t>(3 + p % 2)};
    const EncodedPendingLevel encoded = part.encoded();
    EXPECT_EQ(encoded.vertices, part.mesh.vertices.size());
    EXPECT_EQ(encoded.triangles, part.level.triangles.size());
    const std::array<const Part*, 1> parts{&part};
    const PendingLevel back = merged(parts, std::array<std::uint32_t, 1>{100});
    EXPECT_EQ(back.mesh.chunks, part.mesh.chunks);
    EXPECT_EQ(back.mesh.positionCount, part.mesh.positionCount);
    ASSERT_EQ(back.level.triangles.size(), part.level.triangles.size());
    ASSERT_EQ(back.level.clusters.size(), part.level.clusters.size());
    for (std::uint32_t t = 0; t < back.level.triangles.size(); ++t) {
        EXPECT_EQ(back.level.errors[t].fromSource, part.level.errors[t].fromSource);
        EXPECT_EQ(back.level.errors[t].toSource, part.level.errors[t].toSource);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t now = back.level.triangles[t][i];
            const std::uint32_t was = part.level.triangles[t][i];
            ASSERT_EQ(back.mesh.vertices[now], part.mesh.vertices[was]);
            ASSERT_EQ(back.mesh.sharers[back.mesh.positionOf[now]], part.mesh.sharers[part.mesh.positionOf[was]]);
        }
    }
    for (std::size_t c = 0; c < back.level.clusters.size(); ++c) {
        const LevelCluster& now = back.level.clusters[c];
        const LevelCluster& was = part.level.clusters[c];
        EXPECT_EQ(now.firstTriangle, was.firstTriangle);
        EXPECT_EQ(now.triangleCount, was.triangleCount);
        EXPECT_EQ(now.vertexCount, was.vertexCount);
        EXPECT_EQ(now.box.min, was.box.min);
        EXPECT_EQ(now.box.max, was.box.max);
        if (was.refinement == hierarchy::kNone) {
            EXPECT_EQ(now.refinement, hierarchy::kNone);
            continue;
        }
        const LevelRefinement& found = back.level.refinements[now.refinement];
        const LevelRefinement& wanted = part.level.refinements[was.refinement];
        EXPECT_EQ(found.place.level, 4U);
        EXPECT_EQ(found.place.page, wanted.place.page + 100); // counted on from what is there already
        EXPECT_EQ(found.place.group, wanted.place.group);
        EXPECT_EQ(found.bounds.center, wanted.bounds.center);
        EXPECT_EQ(found.bounds.radius, wanted.bounds.radius);
        EXPECT_EQ(found.error, wanted.error);
        EXPECT_EQ(found.attributeError, wanted.attributeError);
    }
    EXPECT_LT(back.level.refinements.size(), part.level.refinements.size()); // what nobody uses is left out
}

TEST(PendingLevel, RefinementsOfFinerLevelsThanTheNodesKeepTheirPages) {
    Part part(read::bumpySheet(12), {0, 0});
    for (LevelRefinement& refinement : part.level.refinements)
        refinement.place.level = 3;
    const std::array<const Part*, 1> parts{&part};
    const PendingLevel back = merged(parts, std::array<std::uint32_t, 1>{100});
    for (const LevelRefinement& refinement : back.level.refinements)
        EXPECT_LT(refinement.place.page, part.level.clusters.size());
}

TEST(PendingLevel, VerticesThatBecameTheSameAreCountedOnce) {
    Part part(read::bumpySheet(12), {0, 0});
    LevelCluster& cluster = part.level.clusters[0];
    // One of its corners that another of its triangles has too gets a vertex of its own, and then the same colour, as
    // where two colours of one position were averaged to the same.
    const auto triangles = std::span(part.level.triangles).subspan(cluster.firstTriangle, cluster.triangleCount);
    std::uint32_t* corner = nullptr;
    for (const simplify::Triangle& t : triangles.subspan(1))
        for (std::uint32_t& candidate : triangles[0])
            if (std::find(t.begin(), t.end(), candidate) != t.end()) corner = &candidate;
    ASSERT_NE(corner, nullptr);
    const std::uint32_t vertex = *corner;
    *corner = static_cast<std::uint32_t>(part.mesh.vertices.size());
    part.mesh.vertices.push_back(part.mesh.vertices[vertex]);
    part.mesh.positionOf.push_back(part.mesh.positionOf[vertex]);
    const std::uint32_t before = cluster.vertexCount;
    ++cluster.vertexCount;
    const std::array<const Part*, 1> parts{&part};
    const PendingLevel back = merged(parts, std::array<std::uint32_t, 1>{0});
    EXPECT_EQ(back.level.clusters[0].vertexCount, before);
    EXPECT_EQ(back.mesh.vertices.size(), part.mesh.vertices.size() - 1);
}

TEST(PendingLevel, PartsThatShareAnEdgeAreWeldedThere) {
    const read::CodeMesh sheet = read::bumpySheet(16);
    const auto half = [&](bool isLeft) {
        std::vector<simplify::Triangle> triangles = sheet.triangles;
        std::erase_if(triangles, [&](const simplify::Triangle& t) {
            double x = 0;
            for (const std::uint32_t corner : t)
                x += sheet.positions[corner].x / 3;
            return (x < 0.5) != isLeft;
        });
        return read::CodeMesh(sheet.positions, std::move(triangles));
    };
    const Part left(half(true), {0, 1});
    const Part right(half(false), {2, 4});
    const std::array<const Part*, 2> parts{&left, &right};
    const PendingLevel both = merged(parts, std::array<std::uint32_t, 2>{0, 50});
    EXPECT_EQ(both.mesh.chunks, (simplify::ChunkSpan{0, 4}));
    EXPECT_EQ(both.mesh.vertices.size(), sheet.positions.size());
    EXPECT_EQ(both.mesh.positionCount, sheet.positions.size());
    EXPECT_EQ(both.level.triangles.size(), left.level.triangles.size() + right.level.triangles.size());
    std::vector<Corners> expected = cornersOf(left.mesh, left.level);
    for (const Corners& corners : cornersOf(right.mesh, right.level))
        expected.push_back(corners);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(cornersOf(both.mesh, both.level), expected);
    std::set<std::uint32_t> pages;
    for (const LevelRefinement& refinement : both.level.refinements)
        pages.insert(refinement.place.page);
    EXPECT_EQ(pages.size(), both.level.refinements.size()); // those of the second part are counted from 50
}

TEST(PendingLevel, VerticesOfOnePlaceStayApartWhereTheirColoursDo) {
    Part left(read::bumpySheet(6), {0, 0});
    Part right(read::bumpySheet(6), {1, 1});
    for (hierarchy::Vertex& vertex : right.mesh.vertices)
        vertex.color = 0xFF00FF00U;
    const std::array<const Part*, 2> parts{&left, &right};
    const PendingLevel both = merged(parts, std::array<std::uint32_t, 2>{0, 0});
    EXPECT_EQ(both.mesh.vertices.size(), 2 * left.mesh.vertices.size());
    EXPECT_EQ(both.mesh.positionCount, left.mesh.positionCount);
}

} // namespace
} // namespace gnomon::levels
