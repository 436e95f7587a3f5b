#include "tests/support/code_mesh.h"

#include "core/random.h"

#include <algorithm>
#include <cmath>

namespace gnomon::read {

CodeMesh::CodeMesh(std::vector<glm::dvec3> positionsIn, std::vector<CodeMesh::Triangle> trianglesIn)
    : positions(std::move(positionsIn)), triangles(std::move(trianglesIn)) {
    summary_.path = "made in code";
    summary_.vertexCount = positions.size();
    summary_.faceCount = triangles.size();
    summary_.isDouble = true;
}

void CodeMesh::readVertices(const VertexSink& sink) {
    VertexBlock block;
    block.positions = positions;
    sink(block);
}

void CodeMesh::readTriangles(const TriangleSink& sink) {
    std::vector<TriangleCorners> corners;
    for (const CodeMesh::Triangle& t : triangles)
        corners.push_back({t[0], t[1], t[2]});
    TriangleBlock block;
    block.triangles = corners;
    sink(block);
}

// In blocks of a few, as a file comes.
void CodeMesh::readVertexRange(std::uint64_t begin, std::uint64_t end, const VertexSink& sink) {
    constexpr std::uint64_t kRows = 1000;
    for (; begin < end; begin += kRows) {
        VertexBlock block;
        block.firstVertex = begin;
        block.positions = std::span(positions).subspan(begin, std::min(kRows, end - begin));
        sink(block);
    }
}

bool CodeMesh::readFaceRange(std::uint64_t begin, std::uint64_t end, const TriangleSink& sink) {
    std::vector<TriangleCorners> corners;
    TriangleBlock block;
    block.firstTriangle = begin;
    for (; begin < end; ++begin)
        corners.push_back({triangles[begin][0], triangles[begin][1], triangles[begin][2]});
    block.triangles = corners;
    sink(block);
    return areRegular_;
}

CodeMesh bumpySheet(std::uint32_t n, double scale, const glm::dvec3& origin) {
    std::vector<glm::dvec3> positions;
    std::vector<CodeMesh::Triangle> triangles;
    Random random(7);
    for (std::uint32_t y = 0; y <= n; ++y)
        for (std::uint32_t x = 0; x <= n; ++x) {
            const double u = x / static_cast<double>(n);
            const double v = y / static_cast<double>(n);
            const double height = 0.2 * u * (1 - u) * v + 0.3 / n * random.unit();
            positions.push_back(origin + glm::dvec3(u, height, v) * scale);
        }
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x;
            triangles.push_back({a, a + n + 1, a + 1});
            triangles.push_back({a + 1, a + n + 1, a + n + 2});
        }
    return {std::move(positions), std::move(triangles)};
}

CodeMesh strewnBoxes(std::uint32_t count) {
    constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    std::vector<glm::dvec3> positions;
    std::vector<CodeMesh::Triangle> triangles;
    Random random(11);
    for (std::uint32_t box = 0; box < count; ++box) {
        const glm::dvec3 low(random.unit(), random.unit(), random.unit());
        const glm::dvec3 size = glm::dvec3(random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)) *
                                (0.4 / std::cbrt(count));
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (std::uint32_t corner = 0; corner < 8; ++corner)
            positions.push_back(low + size * glm::dvec3(corner & 1U, corner >> 1U & 1U, corner >> 2U));
        for (const auto& side : kSides) {
            triangles.push_back({first + side[0], first + side[1], first + side[2]});
            triangles.push_back({first + side[0], first + side[2], first + side[3]});
        }
    }
    return {std::move(positions), std::move(triangles)};
}

} // namespace gnomon::read
