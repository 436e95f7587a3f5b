#include "tests/support/patches.h"

#include "preprocess/proximity/triangle_distance.h"

#include <algorithm>
#include <cmath>

namespace gnomon::simplify {

Patch patchOf(const read::CodeMesh& mesh) {
    Patch patch;
    for (const glm::dvec3& p : mesh.positions) {
        const glm::dvec3 steps = glm::floor((p + 1.0) * 1000.0);
        hierarchy::Vertex vertex;
        vertex.position = {
            static_cast<std::uint32_t>(steps.x),
            static_cast<std::uint32_t>(steps.y),
            static_cast<std::uint32_t>(steps.z)};
        patch.vertices.push_back(vertex);
        patch.positionOf.push_back(static_cast<std::uint32_t>(patch.positions.size()));
        patch.positions.push_back(steps);
        patch.isLocked.push_back(p.x < 0.2 ? 1 : 0);
    }
    patch.triangles = mesh.triangles;
    return patch;
}

read::CodeMesh mixedMesh() {
    const read::CodeMesh boxes = read::strewnBoxes(40);
    const read::CodeMesh sheet = read::bumpySheet(12);
    std::vector<glm::dvec3> positions = boxes.positions;
    std::vector<Triangle> triangles = boxes.triangles;
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), sheet.positions.begin(), sheet.positions.end());
    for (const Triangle& t : sheet.triangles)
        triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    Random random(31);
    for (int lone = 0; lone < 60; ++lone) {
        const auto next = static_cast<std::uint32_t>(positions.size());
        const double x = random.unit();
        const double y = random.unit();
        const double z = random.unit();
        for (const glm::dvec3 side : {glm::dvec3(0), glm::dvec3(0.03, 0, 0.001), glm::dvec3(0, 0.02, 0.01)})
            positions.push_back(glm::dvec3(x, y, z) + side);
        triangles.push_back({next, next + 1, next + 2});
    }
    return {std::move(positions), std::move(triangles)};
}

Patch plainPatch(std::vector<glm::dvec3> positions, std::vector<Triangle> triangles) {
    Patch patch;
    patch.vertices.resize(positions.size());
    patch.isLocked.assign(positions.size(), 0);
    for (std::uint32_t p = 0; p < positions.size(); ++p)
        patch.positionOf.push_back(p);
    patch.positions = std::move(positions);
    patch.triangles = std::move(triangles);
    return patch;
}

glm::dvec3 randomPoint(const Patch& patch, const Triangle& triangle, Random& random) {
    const Triangle t = patch.corners(triangle);
    double u = random.unit();
    double v = random.unit();
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    const glm::dvec3& a = patch.positions[t[0]];
    return a + (patch.positions[t[1]] - a) * u + (patch.positions[t[2]] - a) * v;
}

bool has(const Triangle& triangle, std::uint32_t corner) {
    return std::find(triangle.begin(), triangle.end(), corner) != triangle.end();
}

double distanceTo(const Patch& patch, const glm::dvec3& p, const Triangle& triangle) {
    const Triangle t = patch.corners(triangle);
    return std::sqrt(
        proximity::distanceToTriangle(p, patch.positions[t[0]], patch.positions[t[1]], patch.positions[t[2]]).square);
}

} // namespace gnomon::simplify
