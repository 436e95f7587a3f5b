#include "tests/levels/meshes.h"

#include <algorithm>

namespace gnomon::levels {

simplify::Mesh meshOf(const read::CodeMesh& source) {
    simplify::Mesh mesh;
    mesh.grid.origin = glm::dvec3(-1);
    mesh.grid.stepExponent = -10;
    for (const glm::dvec3& p : source.positions) {
        const glm::dvec3 steps = glm::floor((p - mesh.grid.origin) / mesh.grid.step());
        hierarchy::Vertex& vertex = mesh.vertices.emplace_back();
        vertex.position = {
            static_cast<std::uint32_t>(steps.x),
            static_cast<std::uint32_t>(steps.y),
            static_cast<std::uint32_t>(steps.z)};
        mesh.positionOf.push_back(mesh.positionCount++);
        mesh.isBorder.push_back(0);
    }
    mesh.triangles = source.triangles;
    return mesh;
}

std::vector<Corners> cornersOf(const simplify::Mesh& mesh, const Level& level, std::size_t first, std::size_t count) {
    std::vector<Corners> all;
    for (std::size_t t = first; t < first + count; ++t) {
        Corners corners;
        for (std::size_t i = 0; i < 3; ++i)
            corners.at(i) = mesh.vertices[level.triangles[t][i]].position;
        std::sort(corners.begin(), corners.end());
        all.push_back(corners);
    }
    std::sort(all.begin(), all.end());
    return all;
}

std::vector<Corners> cornersOf(const simplify::Mesh& mesh, const Level& level) {
    return cornersOf(mesh, level, 0, level.triangles.size());
}

std::vector<std::uint32_t> groupOfTriangles(const Level& level) {
    std::vector<std::uint32_t> groups(level.triangles.size(), hierarchy::kNone);
    for (std::uint32_t g = 0; g < level.groups.size(); ++g)
        for (std::uint32_t c = 0; c < level.groups[g].clusterCount; ++c) {
            const LevelCluster& cluster = level.clusters[level.groups[g].firstCluster + c];
            for (std::uint32_t t = 0; t < cluster.triangleCount; ++t)
                groups[cluster.firstTriangle + t] = g;
        }
    return groups;
}

} // namespace gnomon::levels
