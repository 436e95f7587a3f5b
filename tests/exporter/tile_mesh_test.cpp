// The mesh of a tile against clipping every triangle by itself.
#include "hierarchy/octahedral.h"
#include "preprocess/exporter/tiles/tile_mesh.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <set>
#include <tuple>

#include <unistd.h>

namespace gnomon::exporter {
namespace {

using hierarchy::Page;
using hierarchy::Vertex;

using TileCorner = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;
using TileTriangles = std::multiset<std::array<TileCorner, 3>>;

TileCorner cornerOf(const Vertex& vertex) {
    return {vertex.position.x, vertex.position.y, vertex.position.z, vertex.normal, vertex.color};
}

void insertTriangle(TileTriangles& triangles, const std::array<TileCorner, 3>& corners) {
    std::array<TileCorner, 3> turned = corners;
    std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
    triangles.insert(turned);
}

TileTriangles trianglesOf(const CutMesh& mesh) {
    TileTriangles triangles;
    for (const auto& [a, b, c] : mesh.triangles)
        insertTriangle(triangles, {cornerOf(mesh.vertices[a]), cornerOf(mesh.vertices[b]), cornerOf(mesh.vertices[c])});
    return triangles;
}

std::uint32_t rounded(double value) {
    return static_cast<std::uint32_t>(std::lround(value));
}

Vertex vertexOf(const ClippedCorner& corner) {
    const glm::dvec3 normal(corner.normal[0], corner.normal[1], corner.normal[2]);
    Vertex vertex;
    vertex.position = {rounded(corner.place[0]), rounded(corner.place[1]), rounded(corner.place[2])};
    vertex.normal = hierarchy::packNormal(normal / glm::length(normal));
    vertex.color = 0;
    for (std::size_t i = 0; i < 4; ++i)
        vertex.color |= rounded(corner.color[i]) << 8 * i;
    return vertex;
}

/// What every triangle of `cluster` leaves in `cell`, each clipped by itself.
void addClipped(const Page& page, const hierarchy::Cluster& cluster, const TileCell& cell, TileTriangles& all) {
    for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
        std::array<ClippedCorner, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const Vertex& vertex = page.vertices[cluster.firstVertex + page.triangles[cluster.firstTriangle + t][k]];
            const glm::dvec3 normal = hierarchy::unpackNormal(vertex.normal);
            corners[k].place = {double(vertex.position.x), double(vertex.position.y), double(vertex.position.z)};
            corners[k].normal = {normal.x, normal.y, normal.z};
            for (std::size_t i = 0; i < 4; ++i)
                corners[k].color[i] = vertex.color >> 8 * i & 255U;
        }
        const std::vector<ClippedCorner> polygon = clipped(corners, cell);
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
            const std::array<Vertex, 3> fan{vertexOf(polygon[0]), vertexOf(polygon[i]), vertexOf(polygon[i + 1])};
            if (fan[0].position != fan[1].position && fan[1].position != fan[2].position &&
                fan[2].position != fan[0].position)
                insertTriangle(all, {cornerOf(fan[0]), cornerOf(fan[1]), cornerOf(fan[2])});
        }
    }
}

/// No compiler's order of arguments shows in the bytes.
bool isInOrderOfUse(const CutMesh& mesh) {
    std::vector<bool> isSeen(mesh.vertices.size());
    std::uint32_t next = 0;
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) {
            if (!isSeen[corner] && corner < next) return false;
            if (!isSeen[corner]) next = corner + 1;
            isSeen[corner] = true;
        }
    return true;
}

TEST(TileMesh, IsWhatClippingEveryTriangleMakes) {
    const std::string path = testing::TempDir() + "gnomon_tile_mesh_" + std::to_string(::getpid()) + ".gnm";
    tests::TinyModelOptions options;
    options.gridExponent = 5;
    options.normals = true;
    options.colors = true;
    tests::writeModel(tests::makeTinyModel(options), path);
    const hierarchy::ModelFile file(path);
    NoProgress progress;
    const std::vector<TileCluster> clusters = clustersOf(file, progress);
    std::vector<const TileCluster*> cut;
    hierarchy::GridBox bounds;
    for (const TileCluster& cluster : clusters) {
        bounds.add(cluster.box);
        if (cluster.isInCut(0)) cut.push_back(&cluster);
    }
    const std::uint64_t side = std::bit_ceil(std::uint64_t{std::max(bounds.max.x, bounds.max.z)} + 1);
    PageCache pages(file, gibibytes(1));
    std::size_t compared = 0;
    for (const std::uint64_t part : {side, side / 2, side / 8})
        for (std::uint64_t x = 0; x < side; x += part)
            for (std::uint64_t z = 0; z < side; z += part) {
                const TileCell cell{{x, 0, z}, part};
                TileTriangles expected;
                for (const TileCluster* const member : cut) {
                    const Page page = file.readPage(member->page);
                    addClipped(page, page.clusters[member->cluster], cell, expected);
                }
                const CutMesh mesh = tileMesh(cut, cell, 0, file.summary(), pages);
                ASSERT_EQ(trianglesOf(mesh), expected);
                std::set<TileCorner> corners;
                for (const Vertex& vertex : mesh.vertices)
                    EXPECT_TRUE(corners.insert(cornerOf(vertex)).second) << "welded";
                EXPECT_TRUE(isInOrderOfUse(mesh));
                compared += expected.size();
            }
    EXPECT_GT(compared, 3000U);
    std::filesystem::remove(path);
}

} // namespace
} // namespace gnomon::exporter
