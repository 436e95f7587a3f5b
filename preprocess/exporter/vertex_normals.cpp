#include "preprocess/exporter/vertex_normals.h"

#include "hierarchy/octahedral.h"

#include <algorithm>

namespace gnomon::exporter {

using namespace hierarchy;

VertexNormals::VertexNormals(const CutMesh& mesh, const ModelSummary& summary) : mesh_(mesh), summary_(summary) {
    const auto isMissing = [](const Vertex& vertex) { return vertex.normal == kNoNormal; };
    if (!summary.hasNormals || std::none_of(mesh.vertices.begin(), mesh.vertices.end(), isMissing)) return;
    sums_.resize(mesh.vertices.size(), glm::dvec3(0));
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto at = [&](std::uint32_t v) { return summary.grid.world(mesh.vertices[v].position); };
        const glm::dvec3 normal = glm::cross(at(b) - at(a), at(c) - at(a));
        for (const std::uint32_t corner : {a, b, c})
            sums_[corner] += normal;
    }
}

glm::vec3 VertexNormals::operator[](std::size_t v) const {
    const glm::dvec3 stored = unpackNormal(mesh_.vertices[v].normal);
    const glm::dvec3 normal = stored != glm::dvec3(0) || sums_.empty() ? stored : sums_[v];
    const double length = glm::length(normal);
    return length > 0 ? glm::vec3(normal / length) : glm::vec3(summary_.up.direction);
}

} // namespace gnomon::exporter
