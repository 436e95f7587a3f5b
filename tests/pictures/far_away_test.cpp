// The same model at the origin and ten thousand kilometres from it, as survey coordinates are: the same picture.
#include "core/file.h"
#include "preprocess/read/open_mesh_sources.h"
#include "tests/pictures/pictured_model.h"

#include <gtest/gtest.h>

namespace gnomon::tests {
namespace {

constexpr double kFar = 1e7;

template <class Value>
void append(std::string& bytes, Value value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// The mesh of `from`, moved by `offset`, as a PLY of doubles.
void writeMoved(const std::string& from, const glm::dvec3& offset, const std::string& to) {
    const auto source = read::openMeshSources({from}, gibibytes(1));
    std::string vertices;
    std::string faces;
    std::uint64_t faceCount = 0;
    source->readVertices([&](const read::VertexBlock& block) {
        for (const glm::dvec3& position : block.positions)
            for (int axis = 0; axis < 3; ++axis)
                append(vertices, position[axis] + offset[axis]);
    });
    source->readTriangles([&](const read::TriangleBlock& block) {
        for (const read::TriangleCorners& triangle : block.triangles) {
            append(faces, std::uint8_t{3});
            for (const std::uint64_t corner : triangle)
                append(faces, static_cast<std::uint32_t>(corner));
        }
        faceCount += block.triangles.size();
    });
    const std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                               std::to_string(source->summary().vertexCount) +
                               "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                               std::to_string(faceCount) + "\nproperty list uchar uint vertex_indices\nend_header\n";
    writeTextFile(to, header + vertices + faces);
}

struct Case {
    const char* kind;
    std::uint64_t triangles;
};

class FarAway : public testing::TestWithParam<Case> {};

/// `views` of a model, all moved by `offset`. One model at a time: a context of OpenGL is current until it goes.
std::vector<Drawn> pictures(
    const std::string& path, Backend backend, std::vector<plan::View> views, const glm::dvec3& offset) {
    PicturedModel model(path, backend);
    std::vector<Drawn> drawn;
    for (plan::View& view : views) {
        view.camera.eye += offset;
        view.camera.target += offset;
        drawn.push_back(model.draw(view, 1));
    }
    return drawn;
}

TEST_P(FarAway, ShowsTheSamePicture) {
    const ScratchFile mesh("mesh.ply");
    const ScratchFile movedMesh("moved.ply");
    const ScratchFile model("model.gnm");
    const ScratchFile movedModel("moved.gnm");
    writeMade(GetParam().kind, GetParam().triangles, mesh.path());
    writeMoved(mesh.path(), glm::dvec3(kFar), movedMesh.path());
    build(mesh.path(), model.path());
    build(movedMesh.path(), movedModel.path());
    const std::vector<plan::View> views = threeViews(hierarchy::ModelFile(model.path()), 400);
    for (const Backend backend : {Backend::Software, Backend::Osmesa}) {
        const std::vector<Drawn> nearby = pictures(model.path(), backend, views, glm::dvec3(0));
        const std::vector<Drawn> away = pictures(movedModel.path(), backend, views, glm::dvec3(kFar));
        for (std::size_t i = 0; i < nearby.size(); ++i)
            EXPECT_LE(render::difference(nearby[i].picture, away[i].picture).changedFraction, 0.001)
                << (backend == Backend::Software ? "software" : "osmesa") << ", view " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Made,
    FarAway,
    testing::Values(Case{"statue", 60'000}, Case{"plant", 60'000}, Case{"planes", 60'000}),
    [](const auto& each) { return each.param.kind; });

} // namespace
} // namespace gnomon::tests
