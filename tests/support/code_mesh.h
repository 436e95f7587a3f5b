// Mesh sources made in code, for tests of a build's later stages.
#pragma once

#include "preprocess/read/mesh_source.h"

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::read {

/// A mesh in memory as a source.
class CodeMesh final : public MeshSource {
public:
    using Triangle = std::array<std::uint32_t, 3>;

    CodeMesh(std::vector<glm::dvec3> positions, std::vector<Triangle> triangles);

    CodeMesh(const CodeMesh& other) : CodeMesh(other.positions, other.triangles) {}

    ~CodeMesh() override = default;
    CodeMesh& operator=(const CodeMesh&) = delete;
    CodeMesh(CodeMesh&&) = delete;
    CodeMesh& operator=(CodeMesh&&) = delete;

    const MeshSummary& summary() const override { return summary_; }

    void readVertices(const VertexSink& sink) override;
    void readTriangles(const TriangleSink& sink) override;
    void readVertexRange(std::uint64_t begin, std::uint64_t end, const VertexSink& sink) override;
    bool readFaceRange(std::uint64_t begin, std::uint64_t end, const TriangleSink& sink) override;

    /// Makes the mesh readable by ranges of rows. Irregular rows are ranges that only a complete pass can find.
    CodeMesh& withRanges(bool areRegular = true) {
        summary_.hasRanges = true;
        areRegular_ = areRegular;
        return *this;
    }

    std::vector<glm::dvec3> positions;
    std::vector<Triangle> triangles;

private:
    MeshSummary summary_;
    bool areRegular_ = true;
};

/// Returns a bumpy height field of `n` x `n` squares over the unit square times `scale`, at `origin`.
CodeMesh bumpySheet(std::uint32_t n, double scale = 1, const glm::dvec3& origin = glm::dvec3(0));

/// Returns `count` small boxes of 12 triangles in the unit cube. No two of them share an edge.
CodeMesh strewnBoxes(std::uint32_t count);

} // namespace gnomon::read
