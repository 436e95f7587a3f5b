// A streamed OBJ against OpenMesh's reader, which holds the file: the same triangles of the same corners, the same
// counts, the same errors.
#include "core/random.h"
#include "preprocess/read/obj/obj_lines.h"
#include "preprocess/read/obj/obj_source.h"
#include "preprocess/read/whole_file_source.h"
#include "tests/read/collect.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <sstream>
#include <tuple>

#include <unistd.h>

namespace gnomon::read {
namespace {

constexpr Bytes kObjRoom = mebibytes(256);

class StreamedObj : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder); }

    void TearDown() override { std::filesystem::remove_all(folder); }

    void expectAlike(const std::string& text) {
        writeScratch(path, text);
        expectFilesAlike(path, text);
    }

    static void expectFilesAlike(const std::string& file, const std::string& text);

    const std::string folder = testing::TempDir() + "gnomon_obj_stream_" +
                               testing::UnitTest::GetInstance()->current_test_info()->name() +
                               std::to_string(::getpid());
    const std::string path = folder + "/a.obj";
};

/// All that a corner has.
using Corner = std::tuple<double, double, double, float, float, float, std::uint32_t>;

std::vector<Corner> cornersOf(const CollectedMesh& mesh) {
    std::vector<Corner> corners;
    for (const TriangleCorners& triangle : mesh.triangles)
        for (const std::uint64_t v : triangle) {
            const glm::dvec3& p = mesh.positions[v];
            const glm::vec3 n = mesh.normals.empty() ? glm::vec3(0) : mesh.normals[v];
            corners.emplace_back(p.x, p.y, p.z, n.x, n.y, n.z, mesh.colors.empty() ? 0 : mesh.colors[v]);
        }
    return corners;
}

/// Which corners share a vertex, by its first appearance.
std::vector<std::size_t> sharingOf(const CollectedMesh& mesh) {
    std::vector<std::size_t> names(mesh.positions.size(), 0);
    std::vector<std::size_t> sharing;
    std::size_t next = 0;
    for (const TriangleCorners& triangle : mesh.triangles)
        for (const std::uint64_t v : triangle) {
            if (names[v] == 0) names[v] = ++next;
            sharing.push_back(names[v]);
        }
    return sharing;
}

void StreamedObj::expectFilesAlike(const std::string& file, const std::string& text) {
    std::unique_ptr<MeshSource> whole;
    std::unique_ptr<MeshSource> streamed;
    CollectedMesh wholeMesh;
    CollectedMesh streamedMesh;
    const std::string expected = errorAbout(file, [&] {
        whole = readWholeFile(file, {std::uint64_t{1} << 40U});
        wholeMesh = collect(*whole);
    });
    const std::string found = errorAbout(file, [&] {
        streamed = streamObj(file, kObjRoom);
        streamedMesh = collect(*streamed);
    });
    ASSERT_EQ(found, expected) << text;
    if (expected != "no error") return;
    ASSERT_EQ(cornersOf(streamedMesh), cornersOf(wholeMesh)) << text;
    ASSERT_EQ(sharingOf(streamedMesh), sharingOf(wholeMesh)) << text;
    const MeshSummary& a = streamed->summary();
    const MeshSummary& b = whole->summary();
    EXPECT_EQ(a.vertexCount, b.vertexCount) << text;
    EXPECT_EQ(a.faceCount, b.faceCount) << text;
    EXPECT_EQ(a.likelyTriangles, b.likelyTriangles) << text;
    EXPECT_EQ(a.hasNormals, b.hasNormals) << text;
    EXPECT_EQ(a.hasColors, b.hasColors) << text;
    EXPECT_EQ(a.isDouble, b.isDouble);
    EXPECT_EQ(a.attributesDropped, b.attributesDropped) << text;
    EXPECT_EQ(a.filesBesides, b.filesBesides);
    EXPECT_EQ(streamedMesh.notAPolygon, wholeMesh.notAPolygon) << text;
    EXPECT_EQ(collect(*streamed), streamedMesh) << "passes repeat";
}

const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n";

TEST_F(StreamedObj, IsTheMeshOfAPlainFile) {
    expectAlike(kCorners + "f 1 2 3 4\nf -5 -4 -1\nf 1/2 2/ 3/1/ 5\n");
    expectAlike("# a\r\n\r\n  v +0 0 0\r\nv\t1 0 0 1\r\nv 0 1 0 # here\r\nf 1 2 \\\r\n 3\r\nvt 0 0\nl 1 2\np 1\ng a\n");
    expectAlike("f 1 2 3\nv 0 0 0\nv 1 0 0\nf 1 2 -1\nv 0 1 0\nf -1 -2 -3");
    expectAlike(kCorners + "f 1 2\nf 1 1 2\nf\nf 1 2 3\nf 1 2 3 2 1\nf 1 99\n");
}

TEST_F(StreamedObj, HasTheNormalsOfItsCorners) {
    const std::string normals = "vn 0 0 1\nvn 1 0 0\nvn 0 0 1\nvn 0 1 0\nvn 1 1 1\n";
    expectAlike(kCorners + normals + "f 1//1 2//2 3//3\nf 3//3 4//4 5//5\nf 1 2 3\n");
    expectAlike(
        kCorners + normals + "f 1//1 2//1 3//1\nf 1//2 4//2 3//2\nf 1//3 2//1 5//2\nf 1//2 2//2 3//2\nf 1 2 3\n");
    expectAlike(kCorners + normals + "f 1//9 2//-9 3//1\nf 1//1 2//-1 1//2\n");
    expectAlike(kCorners + normals + "f 1//1 2//2\nf 1//2 1//3 1//2\nf 1 2 3\nf 1//4 1//2 2 3\n");
    expectAlike(kCorners + "f 1//1 2//1 3//1\n");
    expectAlike(kCorners + "vn 3e38 3e38 0\nvn 0 1 0\nf 1//1 2//2 3//1\n");
    expectAlike(kCorners + "f 1//1 2//2 3//3\nvn 0 0 1\nvn 1 0 0\n");
}

/// Faces of very many corners that have other normals than their vertices had before: a look at all of them for each
/// corner takes minutes. So do faces that are none, whose normals count until the next one.
TEST_F(StreamedObj, HasTheNormalsOfVeryManyCorners) {
    constexpr int kCornerCount = 300000;
    std::ostringstream own; // triangles that give each vertex its own normal
    std::ostringstream others;
    std::ostringstream none;
    std::ostringstream large; // one face
    for (int i = 1; i <= kCornerCount; ++i)
        own << "v " << i << ' ' << i % 2 << " 0\nvn 0 " << i << " 1\n";
    own << "vn 1 0 0\n";
    large << 'f';
    for (int i = 1; i <= kCornerCount; ++i) {
        const std::string other = std::to_string(i) + "//" + std::to_string(kCornerCount + 1);
        const char* const begin = i % 3 == 1 ? "f " : " ";
        const char* const end = i % 3 == 0 ? "\n" : "";
        own << begin << i << "//" << i << end;
        others << begin << other << end;
        none << "f " << other << ' ' << other << ' ' << other << '\n';
        large << ' ' << other;
    }
    expectAlike(own.str() + others.str() + none.str() + "f 1//1 2//2 3//3 4 5//5\n");
    writeScratch(path, own.str() + large.str() + "\nf 1 2 3\n");
    const auto streamed = streamObj(path, kObjRoom);
    EXPECT_EQ(streamed->summary().vertexCount, 2U * kCornerCount);
}

TEST_F(StreamedObj, HasTheColoursOfVerticesAndMaterials) {
    writeScratch(folder + "/a.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nmap_Kd a.png\n");
    const std::string vivid = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0.25 2 -1\nv 0 1 0 1 1 1\n";
    expectAlike(vivid + "f 1 2 3\n");
    const std::string library = "mtllib a.mtl\n";
    expectAlike(library + vivid + "usemtl red\nf 1 2 3\n");
    expectAlike(library + kCorners + "usemtl red\nf 1 2 3\nusemtl blue\nf 1 3 4\nusemtl none\nf 1 2 5\nf 3 4 1\n");
    expectAlike(
        library + kCorners +
        "vn 0 0 1\nvn 1 0 0\nusemtl red\nf 1//1 2//1 3//1\nusemtl blue\nf 1//2 3//1 4//2\nf 1 2 3\n");
    expectAlike(
        library + kCorners +
        "vn 0 0 1\nvn 1 0 0\nvn 0 1 0\nusemtl red\nf 1//1 2//2 3//3\nusemtl blue\nf 3//3 2//2 4\n");
    expectAlike("mtllib gone.mtl\n" + kCorners + "usemtl red\nf 1 2 3\n");
}

TEST_F(StreamedObj, SaysWhatIsWrongInTheSameWords) {
    for (const char* const text :
         {"v 0 0 0\nv 1 x 0\n",
          "v 0 0 0\nv 1 0\n",
          "v 0 0 1e99\n",
          "v 0 0 nan\n",
          "v 0 0 0\nf 1 2 4\n",
          "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n",
          "v 0 0 0\nvn 0 0 1\nf //1 //1 //1\n",
          "v 0 0 0\nf 0 1 1\n",
          "v 0 0 0\nf 1 1 99999999999\n",
          "v 0 0 0\nv 1 0 0\n",
          "g a\n",
          "v 0 0 0\nf 1 2 \\\n",
          "v 0 0 0\nf 1 1 1\n",
          "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2\nf 1 2 9\nf 1 2 8\n",
          "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 9//1\n",
          "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1 2 3\nf 1 9//1\n",
          "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//2 3\nf 1 9//-7\n",
          "v 0 0 0\nf 1 9//-7\n",
          "v 0 0 0 0 1 0x\nv 1 0 0 0 1 0x\nv 0 1 0 0 1 0x\nf 1 2 3\n",
          "v 0 0 0 0 1 inf\nv 1 0 0 0 1 inf\nv 0 1 0 0 1 inf\nf 1 2 3\n"})
        expectAlike(text);
}

TEST_F(StreamedObj, WithColoursAtSomeVerticesIsRefused) {
    writeScratch(path, "v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string message = errorAbout(path, [&] { streamObj(path, kObjRoom); });
    EXPECT_NE(message.find("of whose vertices some have colours"), std::string::npos) << message;
    writeScratch(path, kCorners + "vc 1 0 0\nf 1 2 3\n");
    EXPECT_NE(errorAbout(path, [&] { streamObj(path, kObjRoom); }), "no error");
}

TEST_F(StreamedObj, IsRefusedWhereWhatIsHeldIsTooMuch) {
    std::string text = kCorners + "vn 0 0 1\n";
    for (int i = 0; i < 1000; ++i)
        text += "v 0 0 0\n";
    writeScratch(path, text + "f 1//1 2//1 3//1\n");
    EXPECT_NE(errorAbout(path, [&] { streamObj(path, {1000}); }), "no error");
    writeScratch(path, text + "f 1 2 3\n");
    EXPECT_EQ(errorAbout(path, [&] { streamObj(path, {1000}); }), "no error") << "of faces alone nothing is held";
}

std::string numberBelow(Random& random, std::uint64_t most) {
    return std::to_string(random.below(most));
}

std::string randomOther(Random& random) {
    constexpr std::array kOthers = {
        "usemtl red\n", "usemtl blue\n", "usemtl none\n", "vt 0 1\n", "# x\n", "\n", "g a b\n"};
    return kOthers.at(random.below(kOthers.size()));
}

/// A face of two to five corners, some counted from the end, some with normals.
std::string randomFace(Random& random, std::uint64_t vertices, std::uint64_t normals, bool isAligned) {
    std::string text = "f";
    for (std::uint64_t corners = 2 + random.below(4); corners > 0; --corners) {
        const std::uint64_t vertex = 1 + random.below(vertices);
        text += " " + (random.below(3) == 0 ? "-" + std::to_string(vertices + 1 - vertex) : std::to_string(vertex));
        if (isAligned && random.below(4) > 0) text += "//" + std::to_string(vertex);
        if (!isAligned && random.below(2) == 0) text += "/1/" + std::to_string(1 + random.below(normals + 2));
    }
    return text + (random.below(8) == 0 ? " \\\n\n" : "\n");
}

/// A file of random lines, most of them good.
std::string randomObj(Random& random) {
    std::string text = random.below(2) == 0 ? "mtllib a.mtl\n" : "";
    const bool isVivid = random.below(4) == 0;
    const bool isAligned = random.below(3) == 0;
    std::uint64_t vertices = 0;
    std::uint64_t normals = 0;
    for (int line = 0; line < 60; ++line) {
        const std::uint64_t kind = random.below(10);
        if (vertices < 3 || kind < 2) {
            text += "v " + numberBelow(random, 9) + " " + numberBelow(random, 9) + ".5 -" + numberBelow(random, 3) +
                    (isVivid ? " 0.5 0 1" : "") + "\n";
            ++vertices;
        } else if (kind < 4) {
            text += "vn " + numberBelow(random, 2) + " " + numberBelow(random, 2) + " " + numberBelow(random, 2) + "\n";
            ++normals;
        } else {
            text += kind == 4 ? randomOther(random) : randomFace(random, vertices, normals, isAligned);
        }
    }
    return text;
}

TEST_F(StreamedObj, RandomFilesAreTheSameMesh) {
    writeScratch(folder + "/a.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    for (std::uint64_t seed = 0; seed < 1500 && !HasFatalFailure(); ++seed) {
        Random random(seed);
        expectAlike(randomObj(random));
    }
}

TEST_F(StreamedObj, MutatedFilesAreTheSameMeshOrTheSameError) {
    for (std::uint64_t seed = 0; seed < 1500 && !HasFatalFailure(); ++seed) {
        Random random(seed);
        std::string text = kCorners + "vn 0 0 1\nvn 1 0 0\nf 1//1 2//1 3/1/2\nf 1 2 3 4\nf -1 -2 -3\n";
        if (random.below(4) == 0) text.resize(random.below(text.size()));
        for (std::uint64_t n = 1 + random.below(3); n > 0 && !text.empty(); --n)
            text[random.below(text.size())] = "/ -0.9\n#1\\f"[random.below(11)];
        expectAlike(text);
    }
}

TEST_F(StreamedObj, LongFilesAreReadInStretchesThatArePassedOver) {
    std::string text;
    for (int i = 0; i < 120'000; ++i)
        text += "v " + std::to_string(i) + " " + std::to_string(i % 7) + " 0\n";
    for (int i = 0; i < 60'000; ++i)
        text += "vn 0 " + std::to_string(i % 3) + " 1\n";
    for (int i = 1; i < 120'000; ++i)
        text += "f " + std::to_string(i) + "//" + std::to_string(1 + i / 2) + " -3 " + std::to_string(i + 1) + "\n";
    text += "v 5 5 5\n" + std::string(5 << 20, ' ') + "f 1 2 -1\n"; // a line that no buffer holds
    expectAlike(text);
    const InputFile file(path);
    std::vector<ObjStretch> stretches;
    ObjLine line;
    for (ObjLines lines(file, &stretches); lines.next(line);) {
    }
    ASSERT_GT(stretches.size(), 4U);
    EXPECT_EQ(stretches.front().kinds, kindBit(ObjKind::Vertex));
    std::uint64_t faces = 0;
    for (ObjLines lines(file, stretches, kindBit(ObjKind::Face)); lines.next(line); ++faces)
        ASSERT_EQ(line.kind, ObjKind::Face);
    EXPECT_EQ(faces, 120'000U);
}

TEST_F(StreamedObj, IsWhatLargeFilesAreReadAs) {
    std::string text = kCorners;
    for (int i = 0; i < 20'000; ++i)
        text += "f 1 2 3\n";
    writeScratch(path, text);
    EXPECT_GT(readWholeFile(path, mebibytes(64))->summary().heldBytes, text.size());
    EXPECT_LT(readWholeFile(path, mebibytes(1))->summary().heldBytes, 4096U);
}

TEST(ObjFiles, RealOnesAreTheSameStreamed) {
    const char* given = std::getenv("GNOMON_MODELS");
    const std::string files =
        (given != nullptr ? given : GNOMON_SOURCE_DIR "/../shared/models") + std::string("/formats/obj/");
    if (!std::filesystem::exists(files)) GTEST_SKIP() << "no files in " << files << " (set GNOMON_MODELS)";
    int count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(files)) {
        if (entry.path().extension() != ".obj") continue;
        const std::string file = entry.path().string();
        const auto whole = readWholeFile(file, kObjRoom);
        const auto streamed = streamObj(file, kObjRoom);
        const CollectedMesh a = collect(*streamed);
        const CollectedMesh b = collect(*whole);
        EXPECT_EQ(cornersOf(a), cornersOf(b)) << file;
        EXPECT_EQ(sharingOf(a), sharingOf(b)) << file;
        EXPECT_EQ(a.notAPolygon, b.notAPolygon) << file;
        EXPECT_EQ(streamed->summary().attributesDropped, whole->summary().attributesDropped) << file;
        ++count;
    }
    EXPECT_EQ(count, 6);
}

} // namespace
} // namespace gnomon::read
