// Rows that are read from anywhere are those of a whole pass.
#include "core/random.h"
#include "preprocess/read/open_mesh_sources.h"
#include "preprocess/read/ply_fast.h"
#include "tests/read/ply_writer.h"
#include "tests/read/scratch_input.h"

#include <gtest/gtest.h>

namespace gnomon::read {
namespace {

KnownMesh trianglesOnly(std::uint64_t seed, std::size_t vertices, std::size_t faces, const PlyLayout& layout) {
    KnownMesh mesh = randomMesh(seed, vertices, faces, layout);
    std::erase_if(mesh.faces, [](const auto& face) { return face.size() != 3; });
    return mesh;
}

/// What ranges between seeded cuts come to.
CollectedMesh collectByRanges(MeshSource& source, Random& random) {
    CollectedMesh mesh;
    const auto cuts = [&](std::uint64_t rows) {
        std::vector<std::uint64_t> at{0, rows};
        for (int i = 0; i < 6; ++i)
            at.push_back(random.below(rows + 1));
        std::sort(at.begin(), at.end());
        return at;
    };
    const std::vector<std::uint64_t> vertices = cuts(source.summary().vertexCount);
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i)
        source.readVertexRange(vertices[i], vertices[i + 1], [&](const VertexBlock& block) {
            EXPECT_EQ(block.firstVertex, mesh.positions.size());
            mesh.positions.insert(mesh.positions.end(), block.positions.begin(), block.positions.end());
            mesh.normals.insert(mesh.normals.end(), block.normals.begin(), block.normals.end());
            mesh.colors.insert(mesh.colors.end(), block.colors.begin(), block.colors.end());
        });
    const std::vector<std::uint64_t> faces = cuts(source.summary().faceCount);
    for (std::size_t i = 0; i + 1 < faces.size(); ++i) {
        const bool isRegular = source.readTriangleRange(faces[i], faces[i + 1], [&](const TriangleBlock& block) {
            EXPECT_EQ(block.firstTriangle, mesh.triangles.size());
            mesh.triangles.insert(mesh.triangles.end(), block.triangles.begin(), block.triangles.end());
        });
        EXPECT_TRUE(isRegular);
    }
    return mesh;
}

class Ranges : public ScratchInput {
protected:
    std::unique_ptr<MeshSource> opened(const KnownMesh& mesh, const PlyLayout& layout) {
        writeScratch(path, plyText(mesh, layout));
        return openMeshSources({path}, mebibytes(64));
    }
};

void addByChance(Random& random, PlyLayout& layout) {
    if (random.below(2) == 0) layout.normal = "float";
    if (random.below(2) == 0) layout.color = "uchar";
    if (random.below(2) == 0) layout.count = "int";
    if (random.below(2) == 0) layout.index = "uint";
}

TEST_F(Ranges, OfAnyBinaryLayoutAreThoseOfAWholePass) {
    Random random(4);
    for (const char* format : {"binary_little_endian", "binary_big_endian"})
        for (const char* position : {"float", "double", "short"})
            for (const bool facesFirst : {false, true}) {
                PlyLayout layout;
                layout.format = format;
                layout.position = position;
                layout.facesFirst = facesFirst;
                addByChance(random, layout);
                const auto source = opened(trianglesOnly(random.bits(), 40'000, 50'000, layout), layout);
                ASSERT_TRUE(source->summary().hasRanges);
                EXPECT_EQ(collectByRanges(*source, random), collect(*source));
            }
}

TEST_F(Ranges, AreNotOfferedWhereRowsMayLieElsewhere) {
    PlyLayout layout;
    const KnownMesh triangles = trianglesOnly(1, 50, 60, layout);
    EXPECT_TRUE(opened(triangles, layout)->summary().hasRanges);
    EXPECT_FALSE(opened(randomMesh(1, 50, 60, layout), layout)->summary().hasRanges) << "faces of any size";
    PlyLayout extras = layout;
    extras.hasExtras = true;
    EXPECT_FALSE(opened(triangles, extras)->summary().hasRanges) << "lists beside";
    PlyLayout ascii = layout;
    ascii.format = "ascii";
    EXPECT_FALSE(opened(triangles, ascii)->summary().hasRanges);
    PlyLayout narrow = layout;
    narrow.index = "ushort";
    EXPECT_FALSE(opened(triangles, narrow)->summary().hasRanges) << "indices of two bytes are read slowly";
    writeScratch(path, plyText(triangles, layout) + '\n');
    EXPECT_FALSE(openMeshSources({path}, mebibytes(64))->summary().hasRanges) << "a byte too many";
}

// A pair and a quad are as long as two triangles.
TEST_F(Ranges, TellThatARowIsNoTriangleAfterAll) {
    const PlyLayout layout;
    KnownMesh mesh = trianglesOnly(2, 50, 60, layout);
    const auto isRegular = [&](std::uint64_t begin, std::uint64_t end) {
        const auto source = opened(mesh, layout);
        EXPECT_TRUE(source->summary().hasRanges);
        return source->readTriangleRange(begin, end, [](const TriangleBlock&) {});
    };
    const std::uint64_t count = mesh.faces.size();
    EXPECT_TRUE(isRegular(0, count));
    mesh.faces[20] = {1, 2};
    mesh.faces[21] = {1, 2, 3, 4};
    EXPECT_FALSE(isRegular(0, count));
    EXPECT_FALSE(isRegular(20, 21));
    EXPECT_TRUE(isRegular(0, 20));
    EXPECT_TRUE(isRegular(22, count));
    mesh.faces[20] = {1, 2, 3};
    mesh.faces[21] = {1, 2, 50};
    EXPECT_FALSE(isRegular(0, count)) << "an index out of range";
}

TEST_F(Ranges, OfSeveralInputsGoOverTheirBorders) {
    PlyLayout smooth;
    smooth.normal = "float";
    const std::string second = path + "_second.ply";
    writeScratch(path, plyText(trianglesOnly(3, 300, 500, smooth), smooth));
    writeScratch(second, plyText(trianglesOnly(4, 700, 400, PlyLayout()), PlyLayout()));
    const auto source = openMeshSources({path, second, path}, mebibytes(64));
    ASSERT_TRUE(source->summary().hasRanges);
    Random random(5);
    for (int i = 0; i < 20; ++i)
        EXPECT_EQ(collectByRanges(*source, random), collect(*source));
    std::filesystem::remove(second);
}

TEST_F(Ranges, AreNotOfferedWhereOneInputHasNone) {
    writeScratch(path, plyText(trianglesOnly(3, 300, 500, PlyLayout()), PlyLayout()));
    const auto mixed =
        openMeshSources({path, std::string(GNOMON_SOURCE_DIR) + "/data/models/colonnade.obj"}, mebibytes(64));
    EXPECT_FALSE(mixed->summary().hasRanges);
    const VertexSink noVertices = [](const VertexBlock&) {};
    const TriangleSink noTriangles = [](const TriangleBlock&) {};
    EXPECT_THROW(mixed->readVertexRange(0, 301, noVertices), Error);
    EXPECT_THROW((void)mixed->readTriangleRange(0, mixed->summary().faceCount, noTriangles), Error);
}

} // namespace
} // namespace gnomon::read
