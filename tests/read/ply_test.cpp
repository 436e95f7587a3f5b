// The PLY reader against meshes that are known before they are written, in every layout; and its errors.
#include "preprocess/read/block_buffers.h"
#include "preprocess/read/open_mesh_sources.h"
#include "preprocess/read/ply/ply_source.h"
#include "tests/support/ply_writer.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <map>

#include <sys/stat.h>
#include <unistd.h>

namespace gnomon::read {
namespace {

std::string scratchPly(const std::string& name) {
    return testing::TempDir() + "gnomon_read_ply_" + std::to_string(::getpid()) + "_" + name + ".ply";
}

CollectedMesh readPlyText(const std::string& name, const std::string& text) {
    writeScratch(scratchPly(name), text);
    return collect(*openPly(scratchPly(name)));
}

std::string errorOf(const std::string& name, const std::string& text) {
    return errorAbout(scratchPly(name), [&] { readPlyText(name, text); });
}

void expectSame(const PlyLayout& layout, std::uint64_t seed, std::size_t vertices, std::size_t faces) {
    const KnownMesh mesh = randomMesh(seed, vertices, faces, layout);
    EXPECT_EQ(readPlyText("same", plyText(mesh, layout)), expected(mesh))
        << layout.format << " " << layout.position << " " << layout.normal << " " << layout.color << " " << layout.count
        << " " << layout.index << " " << layout.hasExtras << layout.facesFirst;
}

const std::vector<std::string> kFormats = {"ascii", "binary_little_endian", "binary_big_endian"};

void expectSameInEveryFormat(PlyLayout layout, std::uint64_t seed, std::size_t vertices, std::size_t faces) {
    for (const std::string& format : kFormats) {
        layout.format = format;
        expectSame(layout, seed, vertices, faces);
    }
}

TEST(ReadPly, EveryFormatAndTypeOfPositions) {
    PlyLayout layout;
    for (const char* type :
         {"char",
          "int8",
          "uchar",
          "uint8",
          "short",
          "int16",
          "ushort",
          "uint16",
          "int",
          "int32",
          "uint",
          "uint32",
          "float",
          "float32",
          "double",
          "float64"}) {
        layout.position = type;
        expectSameInEveryFormat(layout, 1, 100, 50);
    }
}

TEST(ReadPly, EveryFormatAndTypeOfCountsAndIndices) {
    constexpr std::array kTypes = {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"};
    PlyLayout layout;
    for (const char* count : kTypes)
        for (const char* index : kTypes) {
            layout.count = count;
            layout.index = index;
            expectSameInEveryFormat(layout, 2, 100, 60);
        }
}

TEST(ReadPly, NormalsAndColorsOfEveryUsualType) {
    PlyLayout layout;
    for (const char* normal : {"", "float", "double"})
        for (const char* color : {"", "uchar", "float"}) {
            layout.normal = normal;
            layout.color = color;
            expectSameInEveryFormat(layout, 3, 50, 20);
        }
}

TEST(ReadPly, ElementsInAnyOrderAmongUnknownOnes) {
    PlyLayout layout;
    layout.normal = "float";
    layout.color = "uchar";
    for (const bool hasExtras : {false, true})
        for (const bool facesFirst : {false, true})
            for (const char* lineEnd : {"\n", "\r\n", "\r"}) {
                layout.hasExtras = hasExtras;
                layout.facesFirst = facesFirst;
                layout.lineEnd = lineEnd;
                expectSameInEveryFormat(layout, 4, 70, 40);
            }
}

TEST(ReadPly, MeshesOfMoreThanOneBlockAndOneBuffer) {
    PlyLayout layout;
    layout.position = "double";
    for (const bool hasExtras : {false, true}) {
        layout.hasExtras = hasExtras;
        expectSameInEveryFormat(layout, 5, 3 * kBlockRows + 17, 150'000);
    }
}

TEST(ReadPly, APolygonLargerThanABlockComesInOnePiece) {
    for (const std::string& format : kFormats) {
        PlyLayout layout;
        layout.format = format;
        layout.count = "int";
        KnownMesh mesh = randomMesh(10, 30'000, 20, layout);
        std::vector<std::uint64_t> large(kBlockRows + 5000);
        for (std::size_t i = 0; i < large.size(); ++i)
            large[i] = i;
        mesh.faces.insert(mesh.faces.begin() + 7, large);
        EXPECT_EQ(readPlyText("large", plyText(mesh, layout)), expected(mesh)) << format;
    }
}

TEST(ReadPly, PassesCanBeRepeatedInAnyOrder) {
    PlyLayout layout;
    layout.hasExtras = true;
    layout.facesFirst = true;
    const KnownMesh mesh = randomMesh(6, 90, 90, layout);
    writeScratch(scratchPly("repeat"), plyText(mesh, layout));
    const auto source = openPly(scratchPly("repeat"));
    std::uint64_t triangles = 0;
    source->readTriangles([&](const TriangleBlock& block) { triangles += block.triangles.size(); });
    EXPECT_EQ(triangles, expected(mesh).triangles.size());
    EXPECT_EQ(collect(*source), expected(mesh));
    EXPECT_EQ(collect(*source), expected(mesh));
}

// Each pass opens where the one before ended, so a file may be shorter than the place where its body begins.
TEST(ReadPly, AFileThatShrinksIsRefusedAndSoIsOneThatChanges) {
    const PlyLayout layout;
    const std::string text = plyText(randomMesh(6, 90, 90, layout), layout);
    for (const std::size_t left : {text.size() - 1, text.size() / 2, std::size_t{0}}) {
        writeScratch(scratchPly("shrinks"), text);
        const auto source = openPly(scratchPly("shrinks"));
        collect(*source);
        std::filesystem::resize_file(scratchPly("shrinks"), left);
        EXPECT_THROW(collect(*source), Error) << left;
        EXPECT_THROW(source->requireUnchanged(), Error) << left;
    }
    writeScratch(scratchPly("changes"), text);
    const auto source = openPly(scratchPly("changes"));
    EXPECT_NO_THROW(source->requireUnchanged());
    const auto before = std::filesystem::last_write_time(scratchPly("changes"));
    std::filesystem::last_write_time(scratchPly("changes"), before + std::chrono::seconds(1));
    EXPECT_THROW(source->requireUnchanged(), Error);
}

TEST(ReadPly, TheSummarySaysWhatTheHeaderSays) {
    PlyLayout layout;
    layout.normal = "float";
    layout.position = "double";
    const KnownMesh mesh = randomMesh(7, 33, 10, layout);
    writeScratch(scratchPly("summary"), plyText(mesh, layout));
    const auto source = openPly(scratchPly("summary"));
    EXPECT_EQ(source->summary().vertexCount, 33U);
    EXPECT_EQ(source->summary().faceCount, 11U);
    EXPECT_EQ(source->summary().stripCount, 0U);
    EXPECT_TRUE(source->summary().hasNormals);
    EXPECT_FALSE(source->summary().hasColors);
    EXPECT_TRUE(source->summary().isDouble);
}

// A build asks for memory by it before it has read anything.
TEST(ReadPly, TheSummaryKnowsTheTrianglesOfPolygonsWhereTheBytesTell) {
    PlyLayout layout;
    KnownMesh mesh = randomMesh(7, 33, 10, layout);
    mesh.faces.assign(20, {0, 1, 2, 3, 4});
    const auto likely = [&] {
        writeScratch(scratchPly("likely"), plyText(mesh, layout));
        return openPly(scratchPly("likely"))->summary().likelyTriangles;
    };
    EXPECT_EQ(likely(), 60U);
    layout.hasExtras = true; // other lists, like texture coordinates: their bytes are no corners
    EXPECT_EQ(likely(), 20U);
    layout.hasExtras = false;
    layout.format = "ascii";
    EXPECT_EQ(likely(), 20U);
}

const std::string kVertexHeader = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kFour = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

std::string ascii(const std::string& header, const std::string& body) {
    return "ply\nformat ascii 1.0\n" + header + "end_header\n" + body;
}

TEST(ReadPly, StripsAlternateAndRestart) {
    const std::string strips = "element tristrips 2\nproperty list int int vertex_indices\n";
    const CollectedMesh mesh =
        readPlyText("strips", ascii(kVertexHeader + strips, kFour + "9 0 1 2 3 -1 3 2 1 0\n7 0 1 2 2 3 1 -1\n"));
    const std::vector<TriangleCorners> expectedTriangles = {
        {0, 1, 2}, {2, 1, 3}, {3, 2, 1}, {1, 2, 0}, {0, 1, 2}, {3, 2, 1}};
    EXPECT_EQ(mesh.triangles, expectedTriangles);
}

TEST(ReadPly, DiffuseNamesAndMissingAlpha) {
    const std::string colors =
        "property uchar diffuse_red\nproperty uchar diffuse_green\nproperty uchar diffuse_blue\n";
    const CollectedMesh mesh = readPlyText(
        "diffuse",
        ascii(kVertexHeader + colors + kFaces, "0 0 0 1 2 3\n1 0 0 255 0 0\n1 1 0 0 0 0\n0 1 0 9 9 9\n3 0 1 2\n"));
    EXPECT_EQ(mesh.colors, (std::vector<std::uint32_t>{0xFF030201, 0xFF0000FF, 0xFF000000, 0xFF090909}));
}

TEST(ReadPly, NormalsThatAreNoNumbersAreNone) {
    const std::string normals = "property float nx\nproperty float ny\nproperty float nz\n";
    const CollectedMesh mesh = readPlyText(
        "nannormal",
        ascii(kVertexHeader + normals + kFaces, "0 0 0 0 0 1\n1 0 0 nan 0 0\n1 1 0 0 inf 0\n0 1 0 1 0 0\n3 0 1 2\n"));
    EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}}));
}

TEST(ReadPly, DoublesStayDoubles) {
    const std::string vertices = "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n";
    const CollectedMesh mesh =
        readPlyText("doubles", ascii(vertices + kFaces, "10000000.123456789 0 0\n1 0 0\n1 1 0\n3 0 1 2\n"));
    EXPECT_EQ(mesh.positions[0].x, 10000000.123456789);
}

TEST(ReadPly, RowsMayWrapButNotShareALine) {
    EXPECT_EQ(
        readPlyText("wrap", ascii(kVertexHeader + kFaces, "0 0\n0\n1 0 0\n\n1 1 0\n0 1 0\n3 0\n1 2")).triangles.size(),
        1U);
    EXPECT_EQ(
        errorOf("share", ascii(kVertexHeader + kFaces, "0 0 0 1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n")),
        ":10: more values in a row than the header declares");
}

TEST(ReadPly, HeaderErrorsNameTheLine) {
    EXPECT_EQ(errorOf("h0", ""), ": byte 0: not a PLY file: the first line is not \"ply\"");
    EXPECT_EQ(errorOf("h1", "plyx\n"), ": byte 0: not a PLY file: the first line is not \"ply\"");
    EXPECT_EQ(errorOf("h2", "ply\nformat ascii 1.0\n"), ": byte 21: the header has no end_header");
    EXPECT_EQ(
        errorOf("h3", "ply\nformat ascii 2.0\nend_header\n"),
        ":2: bad format: expected ascii, binary_little_endian or binary_big_endian, version 1.0");
    EXPECT_EQ(errorOf("h4", ascii("element vertex -3\n", "")), R"(:3: bad element count "-3")");
    EXPECT_EQ(errorOf("h5", ascii("element vertex 3\nproperty half x\n", "")), R"(:4: unknown type "half")");
    EXPECT_EQ(
        errorOf("h6", ascii("element vertex 3\nproprety float x\n", "")), R"(:4: unknown header keyword "proprety")");
    EXPECT_EQ(errorOf("h7", ascii("property float x\n", "")), ":3: a property before any element");
    EXPECT_EQ(errorOf("h8", "ply\n" + kVertexHeader + kFaces + "end_header\n"), ":8: the header has no format line");
    EXPECT_EQ(errorOf("h9", ascii(kVertexHeader, kFour)), ": no faces: this is a point cloud; make a mesh of it first");
    EXPECT_EQ(errorOf("h10", ascii(kFaces, "3 0 0 0\n")), ": the header declares no vertices");
    EXPECT_EQ(
        errorOf("h11", ascii("element vertex 1\nproperty float x\nproperty float y\n" + kFaces, "0 0\n3 0 0 0\n")),
        ": the vertices have no x, y and z");
    EXPECT_EQ(
        errorOf("h12", ascii(kVertexHeader + kVertexHeader + kFaces, kFour + kFour + "3 0 1 2\n")),
        ": the header declares vertices twice");
}

TEST(ReadPly, WhatCannotBeReadTwiceIsRefused) {
    std::array<int, 2> pipe{};
    ASSERT_EQ(::pipe(pipe.data()), 0);
    const std::string open = "/dev/fd/" + std::to_string(pipe[0]);
    const std::string named = testing::TempDir() + "gnomon_named_pipe.obj";
    ::unlink(named.c_str());
    ASSERT_EQ(::mkfifo(named.c_str(), 0600), 0);
    const std::map<std::string, std::string> sources{{open, "a pipe"}, {named, "a pipe"}, {"/dev/null", "a device"}};
    for (const auto& [path, kind] : sources) {
        try {
            openMeshSources({path}, gibibytes(1));
            ADD_FAILURE() << path;
        } catch (const Error& error) {
            std::string expected = path;
            expected.append(": a source must be a file, because it is read several times: expected a file, found ")
                .append(kind);
            EXPECT_EQ(error.what(), expected);
        }
    }
    ::unlink(named.c_str());
    ::close(pipe[0]);
    ::close(pipe[1]);
}

TEST(ReadPly, CountsBeyondTheFileAreRefusedAtOnce) {
    EXPECT_EQ(
        errorOf("c1", ascii("element vertex 18446744073709551615\nproperty float x\n" + kFaces, kFour)),
        ": byte 163: the file ends too early: expected 18446744073709551615 rows of element \"vertex\", found room for "
        "at most 12");
    EXPECT_NE(errorOf("c2", ascii("element vertex 18446744073709551616\n", "")), "no error");
}

TEST(ReadPly, BodyErrorsNameTheLine) {
    EXPECT_EQ(
        errorOf("b1", ascii(kVertexHeader + kFaces, kFour + "3 0 1 4\n")),
        ":14: vertex index out of range: expected 0 to less than 4, found 4");
    EXPECT_EQ(
        errorOf("b2", ascii(kVertexHeader + kFaces, kFour + "3 0 1 -1\n")),
        ":14: vertex index out of range: expected 0 to less than 4, found -1");
    EXPECT_EQ(
        errorOf("b3", ascii(kVertexHeader + kFaces, "0 0 0\n1 nan 0\n1 1 0\n0 1 0\n3 0 1 2\n")),
        ":11: a coordinate of vertex 1 is not finite");
    EXPECT_EQ(
        errorOf("b4", ascii(kVertexHeader + kFaces, "0 0 0\n1 0 0\n1 1 0\n0 -1e999 0\n3 3 1 2\n")),
        ":13: a coordinate of vertex 3 is not finite");
    EXPECT_EQ(
        errorOf("b5", ascii(kVertexHeader + kFaces, kFour + "99999 0 1 2\n")),
        ":14: the file ends too early: expected a list of 99999 values in row 1 of 1 of element \"face\", found room "
        "for at most 4");
    EXPECT_EQ(
        errorOf("b6", ascii(kVertexHeader + kFaces, kFour + "-3 0 1 2\n")),
        ":14: invalid list count: expected none below 0, found -3");
    EXPECT_EQ(
        errorOf("b7", ascii(kVertexHeader + kFaces, kFour + "3 0 1")),
        ":14: the file ends too early: expected 1 rows of element \"face\", found 0");
    EXPECT_EQ(
        errorOf("b8", ascii(kVertexHeader + kFaces, kFour + "3 0 1 x\n")),
        ":14: not a whole number: expected an index or a count, found \"x\"");
    EXPECT_EQ(
        errorOf("b9", ascii(kVertexHeader + kFaces, kFour + "3 0 1 2\n3 0 1 2\n")),
        ":15: data after the last element: the header's counts are too small");
    EXPECT_EQ(
        errorOf("b10", ascii(kVertexHeader + kFaces, kFour + "2 0 1\n")), ": no triangles: no face has three corners");
}

TEST(ReadPly, BinaryBodyErrorsNameTheByte) {
    const PlyLayout layout;
    KnownMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.faces = {{0, 1, 2}, {0, 1, 2}};
    const std::string good = plyText(mesh, layout);
    const std::size_t body = good.size() - 62;
    const auto at = [&](std::size_t offset) { return ": byte " + std::to_string(body + offset) + ": "; };

    mesh.faces[1][2] = 3;
    EXPECT_EQ(
        errorOf("B1", plyText(mesh, layout)),
        at(36 + 13 + 9) + "vertex index out of range: expected 0 to less than 3, found 3");
    mesh.faces[1][2] = 2;
    mesh.positions[1].y = std::numeric_limits<double>::infinity();
    EXPECT_EQ(errorOf("B2", plyText(mesh, layout)), at(12) + "a coordinate of vertex 1 is not finite");
    mesh.positions[1].y = 0;
    for (std::size_t cut = 1; cut <= 62; ++cut) {
        const std::string message = errorOf("B3", good.substr(0, good.size() - cut));
        EXPECT_NE(message.find("the file ends too early: expected "), std::string::npos) << cut << message;
        EXPECT_NE(message.find(" of element \""), std::string::npos) << cut << message;
    }
    EXPECT_EQ(
        errorOf("B7", good.substr(0, good.size() - 13)),
        at(49) + "the file ends too early: expected 2 rows of element \"face\", found 1");
    std::string absurd = good;
    absurd[body + 36] = '\x09';
    EXPECT_EQ(
        errorOf("B4", absurd),
        at(36) + "the file ends too early: expected a list of 9 values in row 1 of 2 of element \"face\", found room "
                 "for at most 6");
    EXPECT_EQ(errorOf("B5", good + "x"), at(62) + "data after the last element: the header's counts are too small");
    EXPECT_EQ(errorOf("B6", good + "\n\n"), "no error");
}

TEST(ReadPly, MutatedFilesGiveAMeshOrAnError) {
    std::size_t refused = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        Random random(seed);
        PlyLayout layout;
        layout.format = kFormats[seed % 3];
        layout.hasExtras = random.below(2) == 0;
        layout.facesFirst = random.below(2) == 0;
        layout.color = random.below(2) == 0 ? "" : "uchar";
        std::string text = plyText(randomMesh(seed, 12, 8, layout), layout);
        if (random.below(4) == 0) text.resize(random.below(text.size()));
        for (std::uint64_t n = random.below(4); n > 0 && !text.empty(); --n)
            text[random.below(text.size())] = static_cast<char>(random.bits());
        refused += errorOf("fuzz", text) != "no error" ? 1 : 0;
    }
    EXPECT_GT(refused, 1000U);
    EXPECT_LT(refused, 2900U);
}

/// A PLY of one triangle and a vertex more, with two normals that are not finite.
std::string plyWithBadNormals(bool isAscii, bool hasFaceColors) {
    const float none = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    const std::vector<std::array<float, 6>> rows = {
        {0, 0, 0, none, 0, 1}, {1, 0, 0, 0, 0, 1}, {0, 1, 0, 0, inf, 0}, {1, 1, 0, 0, 0, 0}};
    std::string text =
        std::string("ply\nformat ") + (isAscii ? "ascii" : "binary_little_endian") + " 1.0\nelement vertex 4\n";
    for (const char* const name : {"x", "y", "z", "nx", "ny", "nz"})
        text += std::string("property float ") + name + "\n";
    text += "element face 1\nproperty list uchar uchar vertex_indices\n";
    if (hasFaceColors) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    text += "end_header\n";
    for (const auto& row : rows) {
        for (const float value : row)
            text += isAscii ? std::to_string(value) + " " : std::string(reinterpret_cast<const char*>(&value), 4);
        if (isAscii) text += "\n";
    }
    if (isAscii) return text + std::string("3 0 1 2 9 9 9").substr(0, hasFaceColors ? 13 : 7) + "\n";
    return text + std::string("\3\0\1\2\11\11\11", hasFaceColors ? 7 : 4);
}

void expectTwoBadNormals(const std::string& path) {
    const auto source = openPlyWithFaceColors(path, mebibytes(64));
    const auto& dropped = source->summary().attributesDropped;
    std::uint64_t bad = dropped.contains(kBadNormals) ? dropped.at(kBadNormals) : 0;
    source->readVertices([&](const VertexBlock& block) {
        bad += block.badNormals;
        EXPECT_EQ(block.normals[0], glm::vec3(0));
        EXPECT_EQ(block.normals[1], glm::vec3(0, 0, 1));
    });
    EXPECT_EQ(bad, 2U);
}

TEST(ReadPly, NormalsThatAreNotFiniteAreCountedWhereTheyAreRead) {
    const std::string path = scratchPly("normals");
    for (const bool isAscii : {true, false})
        for (const bool hasFaceColors : {true, false}) {
            writeScratch(path, plyWithBadNormals(isAscii, hasFaceColors));
            expectTwoBadNormals(path);
        }
    std::filesystem::remove(path);
}

} // namespace
} // namespace gnomon::read
