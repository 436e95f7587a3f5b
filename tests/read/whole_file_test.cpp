// OBJ, STL and OFF come out as the same source; bad ones as one error with its line or byte.
#include "core/error.h"
#include "core/random.h"
#include "preprocess/read/open_mesh_sources.h"
#include "preprocess/read/whole_file_source.h"
#include "tests/read/collect.h"

#include <cstring>
#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace gnomon::read {
namespace {

std::string scratchWhole(const std::string& name) {
    return testing::TempDir() + "gnomon_read_whole_" + std::to_string(::getpid()) + "_" + name;
}

CollectedMesh readWholeText(const std::string& name, const std::string& text) {
    writeScratch(scratchWhole(name), text);
    return collect(*openMeshSources({scratchWhole(name)}, mebibytes(64)));
}

std::string errorOfWhole(const std::string& name, const std::string& text) {
    return errorAbout(scratchWhole(name), [&] { readWholeText(name, text); });
}

std::string binaryStl(const std::vector<float>& coordinates) {
    std::string bytes(80, ' ');
    const auto facets = static_cast<std::uint32_t>(coordinates.size() / 9);
    bytes.append(reinterpret_cast<const char*>(&facets), 4);
    for (std::size_t i = 0; i < facets; ++i) {
        bytes.append(12, '\0');
        bytes.append(reinterpret_cast<const char*>(coordinates.data() + 9 * i), 36);
        bytes.append(2, '\0');
    }
    return bytes;
}

const std::string kObj = "# a square and a triangle\n"
                         "mtllib none.mtl\n"
                         "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                         "f 1 2 3 4\n"
                         "usemtl none\n"
                         "f -4 -3 -2\n";

const std::string kStl = "solid outerwall\n"
                         "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 1 1 0\n"
                         " endloop\nendfacet\n"
                         "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 1 0\n  vertex 0 1 0\n"
                         " endloop\nendfacet\n"
                         "endsolid\n";

const std::string kOff = "OFF 4 2 0\n# points\n0 0 0\n1 0 0\n\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3";

TEST(ReadWholeFile, ObjFaces) {
    const CollectedMesh mesh = readWholeText("a.obj", kObj);
    EXPECT_EQ(mesh.positions, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.triangles, (std::vector<TriangleCorners>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
    ASSERT_EQ(mesh.polygons.size(), 1U);
    EXPECT_EQ(mesh.polygons[0].count, 2U);
}

TEST(ReadWholeFile, ObjFacesThatNoHalfEdgeMeshTakes) {
    const CollectedMesh mesh = readWholeText(
        "b.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\nf 2 1 3\nf 1 2 3\n");
    EXPECT_EQ(mesh.triangles.size(), 5U);
}

TEST(ReadWholeFile, ObjNormalsStayPerCornerWhereTheyDiffer) {
    const CollectedMesh mesh = readWholeText(
        "c.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nvn 1 0 0\n"
        "f 1//1 2//1 3//1\nf 1//2 4//2 3//2\nf 1//1 2//1 4//2\nf 1//2 2//2 3//2\nf 1 2 3\n");
    ASSERT_EQ(mesh.triangles.size(), 5U);
    EXPECT_EQ(mesh.triangles[4], mesh.triangles[0]) << "no normals named: those that the vertices had first";
    EXPECT_EQ(mesh.triangles[3][0], mesh.triangles[1][0]) << "the same corner is one vertex";
    const std::vector<std::array<glm::vec3, 3>> normals = {
        {glm::vec3(0, 0, 1), glm::vec3(0, 0, 1), glm::vec3(0, 0, 1)},
        {glm::vec3(1, 0, 0), glm::vec3(1, 0, 0), glm::vec3(1, 0, 0)},
        {glm::vec3(0, 0, 1), glm::vec3(0, 0, 1), glm::vec3(1, 0, 0)}};
    const std::vector<std::array<glm::dvec3, 3>> positions = {
        {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)},
        {glm::dvec3(0, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0)},
        {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)}};
    for (std::size_t t = 0; t < 3; ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(mesh.normals[mesh.triangles[t][k]], normals[t][k]);
            EXPECT_EQ(mesh.positions[mesh.triangles[t][k]], positions[t][k]);
        }
}

TEST(ReadWholeFile, ObjFacesOfTooFewCornersAreCounted) {
    const CollectedMesh mesh = readWholeText("d.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 1 1 2\nf 1 2 3\nf\n");
    EXPECT_EQ(mesh.triangles.size(), 1U);
    EXPECT_EQ(mesh.notAPolygon, 3U);
}

TEST(ReadWholeFile, ObjLinesMayContinue) {
    EXPECT_EQ(readWholeText("e.obj", "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 \\\r\n 3\r\n").triangles.size(), 1U);
}

TEST(ReadWholeFile, ObjErrorsNameTheLine) {
    EXPECT_EQ(errorOfWhole("f.obj", "v 0 0 0\nv 1 x 0\n"), R"(:2: bad number: expected a finite one, found "x")");
    EXPECT_EQ(errorOfWhole("f.obj", "v 0 0 0\nv 1 0\n"), ":2: too few numbers: expected 3, found 2");
    EXPECT_EQ(errorOfWhole("f.obj", "v 0 0 1e99\n"), R"(:1: bad number: expected a finite one, found "1e99")");
    EXPECT_EQ(errorOfWhole("f.obj", "v 0 0 nan\n"), R"(:1: bad number: expected a finite one, found "nan")");
    EXPECT_EQ(
        errorOfWhole("f.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"),
        ":4: vertex index out of range: expected one of 3 vertices, found index 3 counted from 0");
    EXPECT_NE(
        errorOfWhole("f.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n").find(":4: vertex index"), std::string::npos);
    EXPECT_NE(errorOfWhole("f.obj", "v 0 0 0\nvn 0 0 1\nf //1 //1 //1\n").find(":3: bad corner"), std::string::npos);
    EXPECT_NE(errorOfWhole("f.obj", "v 0 0 0\nf 0 1 1\n").find(":2: bad corner"), std::string::npos);
    EXPECT_NE(errorOfWhole("f.obj", "v 0 0 0\nf 1 1 99999999999\n").find(":2: bad corner"), std::string::npos);
    EXPECT_EQ(
        errorOfWhole("f.obj", "v 0 0 0\nv 1 0 0\n"), ": no faces: this is a point cloud; make a mesh of it first");
    EXPECT_EQ(errorOfWhole("f.obj", ""), ": the file is empty");
}

TEST(ReadWholeFile, StlAsciiAndBinaryAgree) {
    const CollectedMesh text = readWholeText("a.stl", kStl);
    EXPECT_EQ(text.triangles.size(), 2U);
    EXPECT_EQ(text.positions.size(), 4U);
    const CollectedMesh binary =
        readWholeText("b.stl", binaryStl({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0}));
    EXPECT_EQ(binary, text);
}

TEST(ReadWholeFile, StlFacetsWithEqualCornersAreCounted) {
    const CollectedMesh mesh =
        readWholeText("c.stl", binaryStl({0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0}));
    EXPECT_EQ(mesh.triangles.size(), 1U);
    EXPECT_EQ(mesh.notAPolygon, 1U);
}

TEST(ReadWholeFile, StlErrorsNameThePlace) {
    const std::string binary = binaryStl({0, 0, 0, 1, 0, 0, 1, 1, 0});
    EXPECT_EQ(
        errorOfWhole("d.stl", binary.substr(0, 120)),
        ": byte 120: neither ascii nor binary STL: expected 134 bytes for 1 facets, found 120");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(
        errorOfWhole("d.stl", binaryStl({0, 0, 0, 1, 0, nan, 1, 1, 0})), ": byte 120: a coordinate is not finite");
    EXPECT_EQ(errorOfWhole("d.stl", kStl.substr(0, kStl.size() - 9)), ":15: the file ends too early: no endsolid");
    EXPECT_EQ(
        errorOfWhole("d.stl", kStl.substr(0, kStl.find("  vertex 1 0 0"))), ":4: the file ends too early: no endsolid");
    EXPECT_EQ(
        errorOfWhole("d.stl", "solid x\nouter loop\nvertex 0 0 0\nendloop\nendsolid\n"),
        R"(:4: bad loop: expected three vertices, found "endloop")");
    EXPECT_EQ(errorOfWhole("d.stl", "solid x\nendsolid\n"), ": empty: it has no vertices and no faces");
}

TEST(ReadWholeFile, OffFaces) {
    const CollectedMesh mesh = readWholeText("a.off", kOff);
    EXPECT_EQ(mesh.positions.size(), 4U);
    EXPECT_EQ(mesh.triangles, (std::vector<TriangleCorners>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(
        readWholeText("a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 2 1 0.5 0 0 1").triangles.size(),
        2U);
}

TEST(ReadWholeFile, OffNormalsAndColors) {
    const CollectedMesh mesh = readWholeText(
        "b.off", "CNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0 255\n1 0 0 0 1 0 0 255 0 255\n0 1 0 1 0 0 0 0 255 128\n3 0 1 2\n");
    EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}));
    EXPECT_EQ(mesh.colors, (std::vector<std::uint32_t>{0xFF0000FF, 0xFF00FF00, 0x80FF0000}));
}

TEST(ReadWholeFile, OffErrorsNameTheLine) {
    EXPECT_EQ(errorOfWhole("c.off", "OF\n1 1 0\n"), ":1: not an OFF file with three coordinates a vertex");
    EXPECT_EQ(
        errorOfWhole("c.off", kOff.substr(0, kOff.find("4 0 1"))),
        ":8: the file ends too early: expected 0 more vertices and 1 more faces, found the end");
    EXPECT_EQ(
        errorOfWhole("c.off", kOff.substr(0, kOff.size() - 1)),
        ":9: bad face: expected a number of corners and as many indices, found 4 words");
    EXPECT_EQ(errorOfWhole("c.off", kOff + "\n3 0 1 2"), ":10: data after the last face: the counts are too small");
    EXPECT_EQ(
        errorOfWhole("c.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 3\n"),
        ":6: vertex index out of range: expected one of 3 vertices, found index 3 counted from 0");
    EXPECT_NE(
        errorOfWhole("c.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 -1\n").find(":6: vertex index"),
        std::string::npos);
    EXPECT_NE(
        errorOfWhole("c.off", "OFF\n3 1 0\n0 0 0\n1 x 0\n1 1 0\n3 0 1 2\n").find(":4: bad number"), std::string::npos);
    EXPECT_NE(errorOfWhole("c.off", "OFF\n3 4000000000 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n"), "no error");
    EXPECT_NE(errorOfWhole("c.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n4000000000 0 1 2\n"), "no error");
}

TEST(ReadWholeFile, TooLargeForTheMemoryIsSaidBeforeReading) {
    std::ofstream(scratchWhole("big.off")) << kOff;
    std::filesystem::resize_file(scratchWhole("big.off"), std::uint64_t{1} << 32U);
    try {
        openMeshSources({scratchWhole("big.off")}, gibibytes(2));
        FAIL() << "a file of 4 GiB passed";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("too large for a format that is read whole"), std::string::npos);
    }
    std::filesystem::remove(scratchWhole("big.off"));
}

TEST(ReadWholeFile, MutatedFilesGiveAMeshOrAnError) {
    const std::vector<std::pair<std::string, std::string>> seeds = {
        {"fuzz.obj", kObj + "vn 0 0 1\nf 1//1 2//1 3/1/1\n"},
        {"fuzz.stl", kStl},
        {"fuzz.off", kOff},
        {"fuzzc.off", "CNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0\n1 0 0 0 1 0 0 255 0\n0 1 0 1 0 0 0 0 255\n3 0 1 2 1 1 0\n"},
        {"fuzzb.stl", binaryStl({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0})},
        {"fuzzb.off",
         std::string("OFF BINARY\n\3\0\0\0\1\0\0\0\0\0\0\0", 23) + std::string(36, '\0') +
             std::string("\3\0\0\0\0\0\0\0\1\0\0\0\2\0\0\0", 16)}};
    for (std::uint64_t seed = 0; seed < 6000; ++seed) {
        Random random(seed);
        const auto& [name, good] = seeds[seed % seeds.size()];
        std::string text = good;
        if (random.below(4) == 0) text.resize(random.below(text.size()));
        for (std::uint64_t n = random.below(4); n > 0 && !text.empty(); --n)
            text[random.below(text.size())] = static_cast<char>(
                random.below(2) == 0 ? random.bits() : static_cast<unsigned char>("/ -0.9\n#"[random.below(8)]));
        errorOfWhole(name, text);
    }
    for (const auto& [name, good] : seeds)
        EXPECT_EQ(errorOfWhole(name, good), "no error") << name;
}

TEST(WholeFile, IsToldByItsSuffixInAnyCase) {
    for (const char* path : {"a.obj", "b.OFF", "c.Stl", "d.ply/e.stl"})
        EXPECT_TRUE(isWholeFileFormat(path)) << path;
    for (const char* path : {"", "obj", "a.ply", "b.objx", "c.stl/d", ".off.gnm"})
        EXPECT_FALSE(isWholeFileFormat(path)) << path;
}

} // namespace
} // namespace gnomon::read
