// A mesh with a large gap in its vertex numbers, as a replacement for a source that is too large for a test.
#pragma once

#include "tests/support/code_mesh.h"

#include <algorithm>
#include <utility>

namespace gnomon::read {

/// A mesh from code with a gap in its vertex numbers. The first `before` vertices keep their numbers. Then follow `gap`
/// unused numbers that are never delivered, then the remaining vertices.
class SpreadMesh final : public MeshSource {
public:
    struct Shape {
        std::uint64_t before = 0;
        std::uint64_t gap = 0;
        bool isQuads = false;    // two successive triangles, where the second begins as the first ends, form one quad
        bool hasNormals = false; // (0, 1, 0) for all vertices
    };

    SpreadMesh(const CodeMesh& mesh, const Shape& shape) : mesh_(mesh), shape_(shape), summary_(mesh.summary()) {
        summary_.vertexCount += shape.gap;
        summary_.faceCount /= shape.isQuads ? 2 : 1;
        summary_.hasNormals = shape.hasNormals;
    }

    const MeshSummary& summary() const override { return summary_; }

    void readVertices(const VertexSink& sink) override {
        const std::vector<glm::vec3> normals(shape_.hasNormals ? mesh_.positions.size() : 0, glm::vec3(0, 1, 0));
        const auto deliver = [&](std::uint64_t begin, std::uint64_t end, std::uint64_t shift) {
            VertexBlock block;
            block.firstVertex = begin + shift;
            block.positions = std::span(mesh_.positions).subspan(begin, end - begin);
            if (shape_.hasNormals) block.normals = std::span(normals).subspan(begin, end - begin);
            sink(block);
        };
        deliver(0, shape_.before, 0);
        deliver(shape_.before, mesh_.positions.size(), shape_.gap);
    }

    void readTriangles(const TriangleSink& sink) override {
        std::vector<TriangleCorners> corners;
        std::vector<PolygonRun> polygons;
        for (const CodeMesh::Triangle& t : mesh_.triangles)
            corners.push_back({spread(t[0]), spread(t[1]), spread(t[2])});
        for (std::uint32_t i = 0; shape_.isQuads && i < corners.size(); i += 2) {
            const std::array<std::uint64_t, 4> quad{corners[i][0], corners[i][1], corners[i + 1][2], corners[i][2]};
            corners[i] = {quad[0], quad[1], quad[2]};
            corners[i + 1] = {quad[0], quad[2], quad[3]};
            polygons.push_back({i, 2});
        }
        TriangleBlock block;
        block.triangles = corners;
        block.polygons = polygons;
        sink(block);
    }

private:
    std::uint64_t spread(std::uint64_t vertex) const { return vertex < shape_.before ? vertex : vertex + shape_.gap; }

    CodeMesh mesh_;
    Shape shape_;
    MeshSummary summary_;
};

} // namespace gnomon::read
