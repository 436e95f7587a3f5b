// Meshes made in code as sources: for the tests of what a build does with one.
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

    /// From now on it can be read by ranges of its rows; irregular rows are some that only a whole pass can tell.
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

/// A bumpy height field of `n` x `n` squares over the unit square times `scale`, at `origin`.
CodeMesh bumpySheet(std::uint32_t n, double scale = 1, const glm::dvec3& origin = glm::dvec3(0));

/// `count` small boxes of 12 triangles strewn in the unit cube, none touching another by an edge.
CodeMesh strewnBoxes(std::uint32_t count);

} // namespace gnomon::read
