// Rows that are read from anywhere are those of a whole pass.
#include "core/random.h"
#include "preprocess/read/open_mesh_sources.h"
#include "preprocess/read/ply/ply_fast.h"
#include "tests/read/scratch_input.h"
#include "tests/support/ply_writer.h"

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
    NoProgress progress;
    EXPECT_TRUE(source.indexRows(progress));
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
        const bool isRegular = source.readFaceRange(faces[i], faces[i + 1], [&](const TriangleBlock& block) {
            EXPECT_EQ(block.firstTriangle, mesh.triangles.size());
            for (const PolygonRun& run : block.polygons)
                mesh.polygons.push_back({static_cast<std::uint32_t>(mesh.triangles.size()) + run.first, run.count});
            mesh.triangles.insert(mesh.triangles.end(), block.triangles.begin(), block.triangles.end());
            mesh.notAPolygon += block.notAPolygon;
        });
        EXPECT_TRUE(isRegular);
    }
    EXPECT_EQ(source.triangleCount(), mesh.triangles.size());
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

// More rows than lie between two places of an index, and ranges that begin anywhere between these.
TEST_F(Ranges, OfRowsOfAnyLengthAreThoseOfAWholePass) {
    Random random(6);
    for (const char* format : {"binary_little_endian", "binary_big_endian", "ascii"})
        for (const bool hasExtras : {false, true}) {
            PlyLayout layout;
            layout.format = format;
            layout.hasExtras = hasExtras;
            layout.facesFirst = !hasExtras;
            layout.lineEnd = random.below(2) == 0 ? "\n" : "\r\n";
            addByChance(random, layout);
            const std::size_t rows = RowIndex::kRows + 20'000;
            const auto source = opened(randomMesh(random.bits(), rows, rows, layout), layout);
            ASSERT_TRUE(source->summary().hasRanges);
            EXPECT_EQ(collectByRanges(*source, random), collect(*source));
            const auto other = openMeshSources({path}, mebibytes(64));
            NoProgress progress;
            other->takeRowIndex(*source->indexRows(progress));
            EXPECT_EQ(collectByRanges(*other, random), collect(*source));
        }
}

TEST_F(Ranges, OfFixedLengthWantNoPassAndOthersDo) {
    const PlyLayout layout;
    const KnownMesh triangles = trianglesOnly(1, 50, 60, layout);
    const auto isReady = [&](const std::string& text) {
        writeScratch(path, text);
        try {
            return openMeshSources({path}, mebibytes(64))->triangleCount() > 0;
        } catch (const Error&) {
            return false;
        }
    };
    PlyLayout ascii = layout;
    ascii.format = "ascii";
    PlyLayout narrow = layout;
    narrow.index = "ushort";
    EXPECT_TRUE(isReady(plyText(triangles, layout)));
    EXPECT_FALSE(isReady(plyText(randomMesh(1, 50, 60, layout), layout))) << "faces of any size";
    EXPECT_FALSE(isReady(plyText(triangles, ascii)));
    EXPECT_FALSE(isReady(plyText(triangles, narrow))) << "indices of two bytes are read slowly";
    EXPECT_FALSE(isReady(plyText(triangles, layout) + '\n')) << "a byte too many";
}

// Only a whole pass says what it is.
TEST_F(Ranges, AreNotFoundInAnInputWithADefect) {
    NoProgress progress;
    for (const char* format : {"binary_little_endian", "ascii"}) {
        PlyLayout layout;
        layout.format = format;
        layout.hasExtras = true;
        const std::string text = plyText(randomMesh(1, 50, 60, layout), layout);
        for (const std::size_t size : {text.size() - 30, text.size() - 40, text.size() - 100}) {
            writeScratch(path, text.substr(0, size));
            const auto source = openMeshSources({path}, mebibytes(64));
            EXPECT_FALSE(source->indexRows(progress)) << format << " " << size;
            EXPECT_THROW((void)collect(*source), Error);
        }
        writeScratch(path, text + "more");
        EXPECT_FALSE(openMeshSources({path}, mebibytes(64))->indexRows(progress)) << format;
    }
}

TEST_F(Ranges, TellThatAnIndexIsOutOfRange) {
    NoProgress progress;
    PlyLayout layout;
    layout.format = "ascii";
    KnownMesh mesh = randomMesh(1, 50, 60, layout);
    mesh.faces[20] = {1, 2, 50};
    const auto source = opened(mesh, layout);
    ASSERT_TRUE(source->indexRows(progress));
    const auto isRegular = [&](std::uint64_t begin, std::uint64_t end) {
        return source->readFaceRange(begin, end, [](const TriangleBlock&) {});
    };
    EXPECT_TRUE(isRegular(0, 20));
    EXPECT_FALSE(isRegular(20, 21));
    EXPECT_FALSE(isRegular(0, 61));
    EXPECT_TRUE(isRegular(21, 61));
    const auto failing = [](const TriangleBlock&) { throw Error("disk full"); };
    EXPECT_THROW((void)source->readFaceRange(0, 20, failing), Error) << "no defect of the input";
}

TEST_F(Ranges, AreRefusedWithTheIndexOfAnotherInput) {
    NoProgress progress;
    PlyLayout layout;
    layout.format = "ascii";
    const RowIndex index = *opened(randomMesh(1, 50, 60, layout), layout)->indexRows(progress);
    const auto isRefused = [&](const RowIndex& other) {
        const auto source = openMeshSources({path}, mebibytes(64));
        try {
            source->takeRowIndex(other);
        } catch (const Error&) {
            return true;
        }
        return false;
    };
    EXPECT_FALSE(isRefused(index));
    RowIndex bad = index;
    bad.parts.push_back(bad.parts[0]);
    EXPECT_TRUE(isRefused(bad));
    bad = index;
    bad.parts[0].faces.push_back({});
    EXPECT_TRUE(isRefused(bad));
    bad = index;
    bad.parts[0].vertices[0].offset = std::uint64_t{1} << 40U;
    EXPECT_TRUE(isRefused(bad));
    writeScratch(path, plyText(trianglesOnly(1, 50, 60, PlyLayout()), PlyLayout()));
    bad = *openMeshSources({path}, mebibytes(64))->indexRows(progress);
    EXPECT_FALSE(isRefused(bad));
    bad.parts[0].faces[0].offset += 1;
    EXPECT_TRUE(isRefused(bad)) << "behind the end of the file";
}

// A pair and a quad are as long as two triangles.
TEST_F(Ranges, TellThatARowIsNoTriangleAfterAll) {
    const PlyLayout layout;
    KnownMesh mesh = trianglesOnly(2, 50, 60, layout);
    const auto isRegular = [&](std::uint64_t begin, std::uint64_t end) {
        const auto source = opened(mesh, layout);
        EXPECT_TRUE(source->summary().hasRanges);
        return source->readFaceRange(begin, end, [](const TriangleBlock&) {});
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
    PlyLayout ascii;
    ascii.format = "ascii";
    Random random(5);
    for (const std::string& more :
         {plyText(trianglesOnly(4, 700, 400, PlyLayout()), PlyLayout()),
          plyText(randomMesh(4, 700, 400, ascii), ascii)}) {
        writeScratch(second, more);
        const auto source = openMeshSources({path, second, path, second}, mebibytes(64));
        ASSERT_TRUE(source->summary().hasRanges);
        for (int i = 0; i < 20; ++i)
            EXPECT_EQ(collectByRanges(*source, random), collect(*source));
    }
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
    EXPECT_THROW((void)mixed->readFaceRange(0, mixed->summary().faceCount, noTriangles), Error);
}

} // namespace
} // namespace gnomon::read
