// Several files as one model: what is joined, what is shifted, and who is named where one is bad.
#include "preprocess/read/open_mesh_sources.h"
#include "tests/support/ply_writer.h"

#include <gtest/gtest.h>

#include <unistd.h>

namespace gnomon::read {
namespace {

std::string scratchPart(const std::string& name) {
    return testing::TempDir() + "gnomon_several_" + std::to_string(::getpid()) + "_" + name + ".ply";
}

/// The four corners of a square and one face.
std::string square(const std::string& face) {
    return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" +
           face;
}

TEST(SeveralInputs, MakeOneModel) {
    const PlyLayout plain;
    PlyLayout colored;
    colored.color = "uchar";
    const KnownMesh first = randomMesh(8, 40, 30, plain);
    const KnownMesh second = randomMesh(9, 20'000, 30'000, colored);
    writeScratch(scratchPart("join1"), plyText(first, plain));
    writeScratch(scratchPart("join2"), plyText(second, colored));
    const auto source = openMeshSources({scratchPart("join1"), scratchPart("join2")}, mebibytes(1));
    EXPECT_TRUE(source->summary().hasColors);
    const CollectedMesh both = collect(*source);
    const CollectedMesh a = expected(first);
    const CollectedMesh b = expected(second);
    ASSERT_EQ(both.positions.size(), 20'040U);
    EXPECT_EQ(both.positions[40], b.positions[0]);
    EXPECT_EQ(both.notAPolygon, a.notAPolygon + b.notAPolygon);
    ASSERT_EQ(both.triangles.size(), a.triangles.size() + b.triangles.size());
    for (std::size_t i = 0; i < b.triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            ASSERT_EQ(both.triangles[a.triangles.size() + i][k], b.triangles[i][k] + 40);
}

TEST(SeveralInputs, HaveNormalsOnlyIfAllHaveSome) {
    PlyLayout plain;
    PlyLayout smooth;
    smooth.normal = "float";
    writeScratch(scratchPart("bare"), plyText(randomMesh(8, 40, 30, plain), plain));
    writeScratch(scratchPart("smooth"), plyText(randomMesh(9, 40, 30, smooth), smooth));
    EXPECT_TRUE(openMeshSources({scratchPart("smooth"), scratchPart("smooth")}, mebibytes(1))->summary().hasNormals);
    const auto mixed = openMeshSources({scratchPart("smooth"), scratchPart("bare")}, mebibytes(1));
    EXPECT_FALSE(mixed->summary().hasNormals);
    mixed->readVertices([](const VertexBlock& block) { EXPECT_TRUE(block.normals.empty()); });
}

TEST(SeveralInputs, AnErrorNamesTheOneThatHasIt) {
    writeScratch(scratchPart("good"), square("3 0 1 2\n"));
    writeScratch(scratchPart("bad"), square("3 0 1 7\n"));
    try {
        collect(*openMeshSources({scratchPart("good"), scratchPart("bad")}, mebibytes(1)));
        FAIL() << "a bad index passed";
    } catch (const Error& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with(scratchPart("bad") + ":14: ")) << error.what();
    }
}

} // namespace
} // namespace gnomon::read
