// Meshes made in code, and what their models look like once read back: for the builder's tests.
#pragma once

#include "hierarchy/model_file.h"
#include "preprocess/build/mesh.h"
#include "preprocess/pipeline/build_model.h"

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::preprocess {

/// A mesh in memory as a source.
class CodeMesh final : public MeshSource {
public:
    CodeMesh(std::vector<glm::dvec3> positions, std::vector<Triangle> triangles);

    CodeMesh(const CodeMesh& other) : CodeMesh(other.positions, other.triangles) {}

    ~CodeMesh() override = default;
    CodeMesh& operator=(const CodeMesh&) = delete;
    CodeMesh(CodeMesh&&) = delete;
    CodeMesh& operator=(CodeMesh&&) = delete;

    const MeshSummary& summary() const override { return summary_; }

    void readVertices(const VertexSink& sink) override;
    void readTriangles(const TriangleSink& sink) override;

    std::vector<glm::dvec3> positions;
    std::vector<Triangle> triangles;

private:
    MeshSummary summary_;
};

/// A bumpy height field of `n` x `n` squares over the unit square times `scale`, at `origin`.
CodeMesh bumpySheet(std::uint32_t n, double scale = 1, const glm::dvec3& origin = glm::dvec3(0));

/// `count` small boxes of 12 triangles strewn in the unit cube, none touching another by an edge.
CodeMesh strewnBoxes(std::uint32_t count);

/// A model built from `mesh`, and its file, gone with the object.
class BuiltModel {
public:
    explicit BuiltModel(CodeMesh mesh, BuildOptions options = {});
    ~BuiltModel();
    BuiltModel(const BuiltModel&) = delete;
    BuiltModel& operator=(const BuiltModel&) = delete;
    BuiltModel(BuiltModel&&) = delete;
    BuiltModel& operator=(BuiltModel&&) = delete;

    const BuildReport& report() const { return report_; }

    const hierarchy::ModelSummary& summary() const { return file_->summary(); }

    const std::vector<hierarchy::Page>& pages() const { return pages_; }

private:
    std::filesystem::path path_;
    BuildReport report_;
    std::unique_ptr<hierarchy::ModelFile> file_;
    std::vector<hierarchy::Page> pages_;
};

} // namespace gnomon::preprocess
