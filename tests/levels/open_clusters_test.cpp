// Pending levels as bytes and back, and neighbours that become one.
#include "preprocess/levels/level_clusters.h"
#include "preprocess/levels/open_clusters.h"
#include "tests/levels/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace gnomon::levels {
namespace {

/// A sheet in clusters with errors and refinements of level 4.
struct Part {
    explicit Part(const read::CodeMesh& source) : mesh(meshOf(source)), level(firstLevel(mesh, {})) {
        for (std::uint32_t t = 0; t < level.errors.size(); ++t)
            level.errors[t] = {0.5F * static_cast<float>(t), 0.25F * static_cast<float>(t)};
        for (std::uint32_t c = 0; c < level.clusters.size(); ++c) {
            level.refinements.push_back({{4, c / 2, c % 2}, {glm::dvec3(c, 2, 3), 10.0 + c}, 20.0 + c, 30.0 + c});
            if (c % 5 != 0) level.clusters[c].refinement = c;
        }
    }

    EncodedOpenClusters encoded() const { return encodeOpenClusters(mesh, level); }

    simplify::Mesh mesh;
    Level level;
};

/// The bytes of each cluster's record.
std::vector<std::vector<std::byte>> recordsOf(const EncodedOpenClusters& encoded) {
    std::vector<std::vector<std::byte>> records;
    std::size_t at = placeBytes(encoded.clusters);
    for (const ClusterPlace& place : clusterPlaces(std::span(encoded.bytes).first(at))) {
        const auto bytes = std::span(encoded.bytes).subspan(at, place.bytes);
        records.emplace_back(bytes.begin(), bytes.end());
        at += place.bytes;
    }
    return records;
}

std::vector<hierarchy::GridPoint> bordersOf(const EncodedOpenClusters& encoded) {
    std::size_t at = placeBytes(encoded.clusters);
    for (const ClusterPlace& place : clusterPlaces(std::span(encoded.bytes).first(at)))
        at += place.bytes;
    return positionsFrom(std::span(encoded.bytes).subspan(at));
}

OpenClusters merged(std::span<const Part* const> parts, std::span<const std::uint32_t> firstPages) {
    std::size_t vertices = 0;
    std::size_t clusters = 0;
    for (const Part* part : parts) {
        vertices += part->encoded().vertices;
        clusters += part->level.clusters.size();
    }
    OpenClusterMerger merger(parts[0]->mesh.grid, clusters, vertices);
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::vector<std::byte>& record : recordsOf(parts[i]->encoded())) {
            countPagesFrom(record, 4, firstPages.subspan(i, 1));
            merger.add(record);
        }
    return merger.take();
}

TEST(OpenClusters, FieldsComeBackAndKeepVerticesApart) {
    Part part(read::bumpySheet(20));
    part.mesh.fields.layout = hierarchy::FieldLayout::of(1);
    for (std::uint32_t v = 0; v < part.mesh.vertices.size(); ++v)
        part.mesh.fields.words.push_back(v % 7000);
    const EncodedOpenClusters encoded = part.encoded();
    OpenClusterMerger merger(part.mesh.grid, encoded.clusters, encoded.vertices, part.mesh.fields.layout);
    for (const std::vector<std::byte>& record : recordsOf(encoded)) {
        merger.add(record);
        EXPECT_EQ(positionsOfRecord(record).empty(), false);
    }
    const OpenClusters back = merger.take();
    ASSERT_EQ(back.mesh.fields.words.size(), back.mesh.vertices.size());
    ASSERT_EQ(back.level.triangles.size(), part.level.triangles.size());
    for (std::uint32_t t = 0; t < back.level.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t was = part.level.triangles[t][i];
            const std::uint32_t is = back.level.triangles[t][i];
            EXPECT_EQ(back.mesh.vertices[is], part.mesh.vertices[was]);
            EXPECT_EQ(back.mesh.fieldsOf(is), part.mesh.fieldsOf(was));
        }
    // A copy of the same clusters with other values shares positions, but no vertices.
    OpenClusterMerger both(part.mesh.grid, 2 * encoded.clusters, 2 * encoded.vertices, part.mesh.fields.layout);
    for (const std::uint32_t more : {0U, 1U}) {
        for (std::uint32_t& word : part.mesh.fields.words)
            word += more;
        for (const std::vector<std::byte>& record : recordsOf(part.encoded()))
            both.add(record);
    }
    const OpenClusters doubled = both.take();
    EXPECT_EQ(doubled.mesh.positionCount, back.mesh.positionCount);
    EXPECT_EQ(doubled.mesh.vertices.size(), 2 * back.mesh.vertices.size());
}

TEST(OpenClusters, ComesBackFromItsBytes) {
    const Part part(read::bumpySheet(30));
    const EncodedOpenClusters encoded = part.encoded();
    EXPECT_EQ(encoded.triangles, part.level.triangles.size());
    EXPECT_EQ(encoded.clusters, part.level.clusters.size());
    const std::array<const Part*, 1> parts{&part};
    const OpenClusters back = merged(parts, std::array<std::uint32_t, 1>{100});
    EXPECT_EQ(back.mesh.positionCount, part.mesh.positionCount);
    EXPECT_EQ(back.mesh.isBorder, std::vector<std::uint8_t>(part.mesh.positionCount, 0));
    ASSERT_EQ(back.level.triangles.size(), part.level.triangles.size());
    ASSERT_EQ(back.level.clusters.size(), part.level.clusters.size());
    for (std::uint32_t t = 0; t < back.level.triangles.size(); ++t) {
        EXPECT_EQ(back.level.errors[t].fromSource, part.level.errors[t].fromSource);
        EXPECT_EQ(back.level.errors[t].toSource, part.level.errors[t].toSource);
        for (std::size_t i = 0; i < 3; ++i)
            ASSERT_EQ(back.mesh.vertices[back.level.triangles[t][i]], part.mesh.vertices[part.level.triangles[t][i]]);
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

TEST(OpenClusters, ClustersOfOneGroupShareItsRefinement) {
    Part part(read::bumpySheet(30));
    for (LevelRefinement& refinement : part.level.refinements)
        refinement = part.level.refinements[0];
    const std::array<const Part*, 1> parts{&part};
    EXPECT_EQ(merged(parts, std::array<std::uint32_t, 1>{0}).level.refinements.size(), 1U);
}

TEST(OpenClusters, PlacesAreTheMiddlesOfTheClustersBoxes) {
    const Part part(read::bumpySheet(30));
    const EncodedOpenClusters encoded = part.encoded();
    const auto places = clusterPlaces(std::span(encoded.bytes).first(placeBytes(encoded.clusters)));
    ASSERT_EQ(places.size(), part.level.clusters.size());
    for (std::size_t c = 0; c < places.size(); ++c) {
        const hierarchy::GridBox& box = part.level.clusters[c].box;
        EXPECT_EQ(places[c].center.x, (box.min.x + box.max.x) / 2);
        EXPECT_EQ(places[c].center.y, (box.min.y + box.max.y) / 2);
        EXPECT_EQ(places[c].center.z, (box.min.z + box.max.z) / 2);
        EXPECT_EQ(places[c].triangles, part.level.clusters[c].triangleCount);
        EXPECT_EQ(places[c].vertices, part.level.clusters[c].vertexCount);
    }
}

TEST(OpenClusters, TellsWhichPositionsAreBordersAndTakesLocks) {
    Part part(read::bumpySheet(30));
    std::set<hierarchy::GridPoint> expected;
    for (std::size_t v = 0; v < part.mesh.vertices.size(); v += 7) {
        part.mesh.isBorder[part.mesh.positionOf[v]] = 1;
        expected.insert(part.mesh.vertices[v].position);
    }
    const EncodedOpenClusters encoded = part.encoded();
    const std::vector<hierarchy::GridPoint> borders = bordersOf(encoded);
    EXPECT_EQ(std::set<hierarchy::GridPoint>(borders.begin(), borders.end()), expected);
    EXPECT_EQ(borders.size(), expected.size()) << "each once";
    OpenClusterMerger merger(part.mesh.grid, encoded.clusters, encoded.vertices);
    for (const std::vector<std::byte>& record : recordsOf(encoded))
        merger.add(record);
    for (const hierarchy::GridPoint& position : borders)
        merger.lock(position);
    const OpenClusters back = merger.take();
    for (std::size_t v = 0; v < back.mesh.vertices.size(); ++v)
        ASSERT_EQ(back.mesh.isBorder[back.mesh.positionOf[v]] != 0, expected.contains(back.mesh.vertices[v].position));
}

TEST(OpenClusters, RefinementsOfFinerLevelsThanTheNodesKeepTheirPages) {
    Part part(read::bumpySheet(12));
    for (LevelRefinement& refinement : part.level.refinements)
        refinement.place.level = 3;
    const std::array<const Part*, 1> parts{&part};
    const OpenClusters back = merged(parts, std::array<std::uint32_t, 1>{100});
    for (const LevelRefinement& refinement : back.level.refinements)
        EXPECT_LT(refinement.place.page, part.level.clusters.size());
}

TEST(OpenClusters, VerticesThatBecameTheSameAreCountedOnce) {
    Part part(read::bumpySheet(12));
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
    const OpenClusters back = merged(parts, std::array<std::uint32_t, 1>{0});
    EXPECT_EQ(back.level.clusters[0].vertexCount, before);
    EXPECT_EQ(back.mesh.vertices.size(), part.mesh.vertices.size() - 1);
}

TEST(OpenClusters, PartsThatShareAnEdgeAreWeldedThere) {
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
    const Part left(half(true));
    const Part right(half(false));
    const std::array<const Part*, 2> parts{&left, &right};
    const OpenClusters both = merged(parts, std::array<std::uint32_t, 2>{0, 50});
    EXPECT_EQ(both.mesh.vertices.size(), sheet.positions.size());
    EXPECT_EQ(both.mesh.positionCount, sheet.positions.size());
    EXPECT_EQ(both.level.triangles.size(), left.level.triangles.size() + right.level.triangles.size());
    std::vector<Corners> expected = cornersOf(left.mesh, left.level);
    for (const Corners& corners : cornersOf(right.mesh, right.level))
        expected.push_back(corners);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(cornersOf(both.mesh, both.level), expected);
    std::set<std::array<std::uint32_t, 2>> groups;
    for (const LevelRefinement& refinement : both.level.refinements)
        groups.insert({refinement.place.page, refinement.place.group});
    EXPECT_EQ(groups.size(), both.level.refinements.size()); // those of the second part are counted from 50
    EXPECT_GT(both.level.refinements.back().place.page, 49U);
}

TEST(OpenClusters, VerticesOfOnePlaceStayApartWhereTheirColoursDo) {
    Part left(read::bumpySheet(6));
    Part right(read::bumpySheet(6));
    for (hierarchy::Vertex& vertex : right.mesh.vertices)
        vertex.color = 0xFF00FF00U;
    const std::array<const Part*, 2> parts{&left, &right};
    const OpenClusters both = merged(parts, std::array<std::uint32_t, 2>{0, 0});
    EXPECT_EQ(both.mesh.vertices.size(), 2 * left.mesh.vertices.size());
    EXPECT_EQ(both.mesh.positionCount, left.mesh.positionCount);
}

} // namespace
} // namespace gnomon::levels
