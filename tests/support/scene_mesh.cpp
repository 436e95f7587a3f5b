#include "tests/support/scene_mesh.h"

#include "hierarchy/codec/cluster_order.h"

#include <cmath>

namespace gnomon::tests {

using namespace hierarchy;

namespace {

constexpr int kStepExponent = -10;
constexpr double kReach = 1 << 20; // of the grid on either side of the scene's origin

GridPoint snapped(const glm::dvec3& position) {
    const auto cell = [](double x) {
        return static_cast<std::uint32_t>(std::llround((x + kReach) * std::exp2(-kStepExponent)));
    };
    return {cell(position.x), cell(position.y), cell(position.z)};
}

} // namespace

void SceneMesh::addQuad(const glm::dvec3& corner, const glm::dvec3& first, const glm::dvec3& second) {
    pieces_.push_back(
        {{corner, corner + first, corner + first + second, corner + second}, {Triangle{0, 1, 2}, Triangle{0, 2, 3}}});
}

void SceneMesh::addBox(const glm::dvec3& min, const glm::dvec3& max) {
    Piece piece;
    for (int i = 0; i < 8; ++i)
        piece.vertices.emplace_back(
            (i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y, (i & 4) != 0 ? max.z : min.z);
    piece.triangles = {
        Triangle{0, 1, 3},
        Triangle{0, 3, 2},
        Triangle{4, 7, 5},
        Triangle{4, 6, 7},
        Triangle{0, 5, 1},
        Triangle{0, 4, 5},
        Triangle{2, 3, 7},
        Triangle{2, 7, 6},
        Triangle{0, 2, 6},
        Triangle{0, 6, 4},
        Triangle{1, 5, 7},
        Triangle{1, 7, 3}};
    pieces_.push_back(std::move(piece));
}

void SceneMesh::addGround(double size, int count, double height) {
    const double tile = size / count;
    for (int z = 0; z < count; ++z)
        for (int x = 0; x < count; ++x)
            addQuad({x * tile - size / 2, height, z * tile - size / 2}, {0, 0, tile}, {tile, 0, 0});
}

TinyModel SceneMesh::model() const {
    constexpr std::size_t kGroupsPerPage = 64;
    TinyModel model;
    ModelSummary& summary = model.summary;
    summary.grid = {origin_ - glm::dvec3(kReach), kStepExponent};
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
        const Piece& piece = pieces_[p];
        if (p % kGroupsPerPage == 0) model.pages.emplace_back();
        Page& page = model.pages.back();
        Cluster cluster;
        cluster.firstVertex = static_cast<std::uint32_t>(page.vertices.size());
        cluster.firstTriangle = static_cast<std::uint32_t>(page.triangles.size());
        cluster.vertexCount = static_cast<std::uint32_t>(piece.vertices.size());
        cluster.triangleCount = static_cast<std::uint32_t>(piece.triangles.size());
        for (const glm::dvec3& position : piece.vertices) {
            Vertex vertex;
            vertex.position = snapped(position);
            page.vertices.push_back(vertex);
            cluster.box.add(vertex.position);
            summary.bounds.add(summary.grid.world(vertex.position));
        }
        page.triangles.insert(page.triangles.end(), piece.triangles.begin(), piece.triangles.end());
        const Box box = summary.grid.local(cluster.box);
        Group group;
        group.firstCluster = static_cast<std::uint32_t>(page.clusters.size());
        group.clusterCount = 1;
        group.box = cluster.box;
        group.bounds = {box.center(), glm::length(box.extent()) * 0.5 * (1 + 1e-9)};
        page.clusters.push_back(cluster);
        page.groups.push_back(group);
        summary.sourceTriangles += piece.triangles.size();
        summary.sourceVertices += piece.vertices.size();
    }
    for (Page& page : model.pages)
        orderForCoding(page);
    summary.coarsestTriangles = summary.sourceTriangles;
    summary.levels.push_back({summary.sourceTriangles, pieces_.size(), pieces_.size(), summary.grid.snapError()});
    summary.options["made_by"] = "tests";
    return model;
}

} // namespace gnomon::tests
