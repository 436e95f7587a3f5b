// Materials of an OBJ: libraries by names with blanks, colours of faces, and what is missing.
#include "core/random.h"
#include "preprocess/read/obj/obj_materials.h"
#include "preprocess/read/open_mesh_sources.h"
#include "preprocess/read/polygon.h"
#include "tests/read/collect.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include <unistd.h>

namespace gnomon::read {
namespace {

constexpr std::uint32_t kRed = 0xFF0000FF;
constexpr std::uint32_t kGreen = 0xFF00FF00;
constexpr std::uint32_t kUncolored = 0xFFFFFFFF;

class ObjWithMaterials : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder); }

    void TearDown() override { std::filesystem::remove_all(folder); }

    CollectedMesh meshOf(const std::string& obj) {
        writeScratch(path, obj);
        return collect(*openMeshSources({path}, mebibytes(64)));
    }

    std::map<std::string, std::uint64_t> rejectedOf(const std::string& obj) {
        writeScratch(path, obj);
        return openMeshSources({path}, mebibytes(64))->summary().attributesDropped;
    }

    const std::string folder = testing::TempDir() + "gnomon_obj_" +
                               testing::UnitTest::GetInstance()->current_test_info()->name() +
                               std::to_string(::getpid());
    const std::string path = folder + "/a.obj";
};

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(ObjWithMaterials, FacesHaveTheDiffuseColourAndSplitVerticesWhereItChanges) {
    writeScratch(folder + "/a.mtl", "# two\nnewmtl red\nKa 1 1 1\n  Kd 1 0 0\r\n\nnewmtl dark  green\nKd 0 0.5 0\n");
    const CollectedMesh mesh =
        meshOf("mtllib a.mtl\n" + kSquare + "usemtl red\nf 1 2 3\nusemtl dark  green\nf 1 3 4\n");
    EXPECT_EQ(
        mesh.positions, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {1, 1, 0}}));
    const auto colorsAt = [&](std::size_t triangle) {
        std::set<std::uint32_t> colors;
        for (const std::uint64_t corner : mesh.triangles[triangle])
            colors.insert(mesh.colors[corner]);
        return colors;
    };
    EXPECT_EQ(colorsAt(0), std::set{kRed});
    EXPECT_EQ(colorsAt(1), std::set<std::uint32_t>{0xFF008000});
    EXPECT_EQ(
        openMeshSources({path}, mebibytes(64))->summary().additionalFiles, std::vector<std::string>{folder + "/a.mtl"});
}

TEST_F(ObjWithMaterials, NamesOfLibrariesMayHaveBlanks) {
    writeScratch(folder + "/my red.mtl", "newmtl Red\nKd 1 0 0\n");
    writeScratch(folder + "/my", "newmtl Red\nKd 0 0 1\n");
    writeScratch(folder + "/green.mtl", "newmtl Green\nKd 0 1 0\n");
    const CollectedMesh mesh =
        meshOf("mtllib gone.mtl my red.mtl green.mtl \n" + kSquare + "usemtl Red\nf 1 2 3\nusemtl Green\nf 1 3 4\n");
    EXPECT_EQ((std::set<std::uint32_t>(mesh.colors.begin(), mesh.colors.end())), (std::set{kRed, kGreen}));
    EXPECT_EQ(
        rejectedOf("mtllib gone.mtl my red.mtl\n" + kSquare + "f 1 2 3\n").at("material libraries that are not there"),
        1U);
}

TEST_F(ObjWithMaterials, WhatIsMissingIsToldAndLeavesTheSurface) {
    writeScratch(folder + "/a.mtl", "Kd 0 0 1\nnewmtl red\nKd 1 0 0\nmap_Kd wood.png\nnewmtl plain\n");
    const std::string text = "mtllib a.mtl\nmtllib /gone/b.mtl\nmtllib ../c.mtl\n" + kSquare +
                             "usemtl red\nf 1 2 3\nusemtl blue\nf 1 3 4\nusemtl plain\nf 1 2 4\n";
    const CollectedMesh mesh = meshOf(text);
    EXPECT_EQ(mesh.triangles.size(), 3U);
    EXPECT_EQ((std::set<std::uint32_t>(mesh.colors.begin(), mesh.colors.end())), (std::set{kRed, kUncolored}));
    const std::map<std::string, std::uint64_t> expected = {
        {"material libraries that are not there", 2}, {"materials that no library has", 1}, {"textures", 1}};
    EXPECT_EQ(rejectedOf(text), expected);
}

TEST_F(ObjWithMaterials, AreNamedAsPeopleNameThem) {
    const std::string faces = kSquare + "usemtl red\nf 1 2 3\n";
    const auto colorsOf = [&](const std::string& obj) {
        const CollectedMesh mesh = meshOf(obj);
        return std::set<std::uint32_t>(mesh.colors.begin(), mesh.colors.end());
    };
    std::filesystem::create_directories(folder + "/Sub Folder");
    writeScratch(folder + "/My Red.mtl", "newmtl red\nKd 1 0 0\n");
    writeScratch(folder + "/Sub Folder/Deep.mtl", "newmtl red\nKd 1 0 0\n");
    for (const char* const line :
         {"mtllib My Red.mtl",
          "mtllib\tMy Red.mtl",
          "  mtllib   My Red.mtl \t",
          "mtllib my red.MTL",
          "mtllib ./My Red.mtl",
          "mtllib .\\My Red.mtl",
          "mtllib Sub Folder/Deep.mtl",
          "mtllib Sub Folder\\Deep.mtl",
          "mtllib SUB FOLDER\\deep.mtl",
          "mtllib Sub Folder\\..\\my red.mtl",
          R"(mtllib C:\Users\Some One\My Red.mtl)",
          "mtllib c:/users/my red.mtl",
          R"(mtllib \\server\share\MY RED.mtl)",
          R"(mtllib ..\..\gone\My Red.mtl)",
          "mtllib /home/gone/My Red.mtl",
          "mtllib gone.mtl C:\\a\\My Red.mtl # a comment",
          "mtllib My \\\nRed.mtl"})
        EXPECT_EQ(colorsOf(std::string(line) + "\n" + faces), std::set{kRed}) << line;
    writeScratch(path, "mtllib C:\\a\\My Red.mtl\nmtllib D:\\b\\My Red.mtl\n" + faces);
    const auto source = openMeshSources({path}, mebibytes(64));
    ASSERT_EQ(source->summary().remarks.size(), 1U) << "printed once";
    EXPECT_EQ(
        source->summary().remarks[0],
        path + ": there is no material library \"C:\\a\\My Red.mtl\"; \"My Red.mtl\" in the folder of the OBJ is read "
               "instead");
    EXPECT_TRUE(openMeshSources({path}, mebibytes(64))->summary().attributesDropped.empty());
    writeScratch(path, "mtllib my red.mtl\n" + faces);
    EXPECT_TRUE(openMeshSources({path}, mebibytes(64))->summary().remarks.empty());
}

TEST_F(ObjWithMaterials, MayHaveAnyNames) {
    writeScratch(
        folder + "/a.mtl",
        "newmtl\tPaint #1\nKd\t1\t0\t0\nnewmtl Paint #2\nKd 0 1 0\nnewmtl red # a comment\nkd 1 0 0\n"
        "newmtl a#b\nKd 0.5\nnewmtl \xC3\xA4\xC3\xB6 \xE2\x98\x83\nKd +0 1e0 .0 # green\n");
    const auto colorOf = [&](const std::string& use) {
        const CollectedMesh mesh = meshOf("mtllib a.mtl\n" + kSquare + use + "\nf 1 2 3\n");
        return mesh.colors.empty() ? kUncolored : mesh.colors[0];
    };
    EXPECT_EQ(colorOf("usemtl Paint #1"), kRed);
    EXPECT_EQ(colorOf("usemtl\tPaint #2"), kGreen);
    EXPECT_EQ(colorOf("  usemtl\t Paint #2 \r"), kGreen);
    EXPECT_EQ(colorOf("usemtl red"), kRed);
    EXPECT_EQ(colorOf("usemtl red # of both"), kRed);
    EXPECT_EQ(colorOf("usemtl a#b"), 0xFF808080) << "one number is a grey";
    EXPECT_EQ(colorOf("usemtl \xC3\xA4\xC3\xB6 \xE2\x98\x83"), kGreen);
    EXPECT_EQ(meshOf(kSquare + "usemtl Paint #1\nmtllib a.mtl\nf 1 2 3\n").colors.at(0), kRed)
        << "a library may follow";
}

TEST_F(ObjWithMaterials, LibrariesOutsideOfTheSourceRootAreRefused) {
    std::filesystem::create_directories(folder + "/deep");
    writeScratch(folder + "/red.mtl", "newmtl red\nKd 1 0 0\n");
    const std::string obj = folder + "/deep/a.obj";
    const auto errorOf = [&](const std::string& line, const std::string& root) {
        writeScratch(obj, line + "\n" + kSquare + "usemtl red\nf 1 2 3\n");
        return errorAbout(obj, [&] {
            const CollectedMesh mesh = collect(*openMeshSources({obj}, mebibytes(64), {}, Textures::Bake, root));
            EXPECT_EQ(mesh.colors.at(0), kRed);
        });
    };
    for (const std::string& line :
         {std::string("mtllib ../red.mtl"),
          std::string("mtllib ..\\red.mtl"),
          std::string("mtllib ..\\RED.mtl"),
          "mtllib " + folder + "/red.mtl"}) {
        EXPECT_EQ(errorOf(line, "").substr(0, 53), ":1: refers to a file outside the folder of the source") << line;
        EXPECT_EQ(errorOf(line, folder), "no error") << line;
    }
}

/// A search for each name, alone and joined to those behind it, would take a minute.
TEST_F(ObjWithMaterials, VeryManyNamesTakeNoTime) {
    std::string many = "mtllib";
    std::string lines;
    for (int i = 0; i < 50'000; ++i) {
        many += " x/" + std::to_string(i);
        lines += "mtllib a/" + std::to_string(i) + " b c d e f g\n";
    }
    EXPECT_EQ(rejectedOf(many + "\n" + kSquare + "f 1 2 3\n").at("material libraries that are not there"), 50'000U);
    EXPECT_EQ(rejectedOf(lines + kSquare + "f 1 2 3\n").at("material libraries that are not there"), 350'000U);
}

TEST_F(ObjWithMaterials, LibrariesInUtf16AreRefused) {
    writeScratch(folder + "/a.mtl", std::string("\xFF\xFEn\0e\0w\0", 8));
    EXPECT_EQ(
        errorAbout(folder + "/a.mtl", [&] { meshOf("mtllib a.mtl\n" + kSquare + "f 1 2 3\n"); }),
        ": the text is in UTF-16; convert to UTF-8");
}

TEST_F(ObjWithMaterials, ColoursOfVerticesComeFirst) {
    writeScratch(folder + "/a.mtl", "newmtl red\nKd 1 0 0\n");
    const std::string text = "mtllib a.mtl\nusemtl red\nv 0 0 0 0 1 0\nv 1 0 0 0 1 0\nv 1 1 0 0 1 0\nf 1 2 3\n";
    EXPECT_EQ(meshOf(text).colors, std::vector<std::uint32_t>(3, kGreen));
    EXPECT_EQ(rejectedOf(text).at("colours of materials, beside those of vertices"), 1U);
    EXPECT_TRUE(meshOf(kSquare + "f 1 2 3\n").colors.empty());
}

TEST_F(ObjWithMaterials, BadColoursAreRefusedWithTheirLine) {
    const std::string library = folder + "/a.mtl";
    for (const char* const color : {"1 0 x", "nan 0 0", "1 inf 0", "1 0", "1 0 # 0", ""}) {
        writeScratch(library, std::string("newmtl red\nKd ") + color + "\n");
        const std::string message = errorAbout(library, [&] { meshOf("mtllib a.mtl\n" + kSquare + "f 1 2 3\n"); });
        EXPECT_TRUE(message.starts_with(":2: bad colour of a material")) << message;
    }
    writeScratch(library, "newmtl red\nKd 7 -3 0\nnewmtl other\nKd spectral a.rfl\n");
    EXPECT_EQ(meshOf("mtllib a.mtl\n" + kSquare + "usemtl red\nf 1 2 3\n").colors, std::vector<std::uint32_t>(3, kRed));
}

std::vector<std::uint32_t> randomReds(Random& random) {
    std::vector<std::uint32_t> colors(1 + random.below(5));
    for (std::uint32_t& color : colors)
        color = 0xFF000000U | static_cast<std::uint32_t>(random.below(256));
    return colors;
}

/// Materials m0, m1 and so on of these colours.
std::string libraryOf(const std::vector<std::uint32_t>& reds) {
    std::string text;
    for (std::size_t i = 0; i < reds.size(); ++i)
        text += "newmtl m" + std::to_string(i) + "\nKd " + std::to_string((reds[i] & 255U) / 255.0) + " 0 0\n";
    return text;
}

// The slow, obviously right reading: each face looked up in a list of what its lines said.
TEST_F(ObjWithMaterials, RandomFilesAgreeWithAPlainReading) {
    Random random(31);
    for (int round = 0; round < 60; ++round) {
        const std::vector<std::uint32_t> colors = randomReds(random);
        writeScratch(folder + "/a.mtl", libraryOf(colors));
        std::string text = "mtllib a.mtl\nusemtl m0\n";
        std::uint64_t used = 0;
        std::vector<std::uint32_t> expected;
        std::uint64_t vertices = 0;
        for (int face = 0; face < 30; ++face) {
            if (vertices < 3 || random.below(3) == 0) {
                for (int k = 0; k < 3; ++k)
                    text += "v " + std::to_string(vertices++) + " " + std::to_string(random.below(9)) + " 0\n";
            }
            if (random.below(2) == 0) {
                used = random.below(colors.size());
                text += "usemtl m" + std::to_string(used) + "\n";
            }
            const std::uint64_t first = 1 + random.below(vertices - 2);
            text +=
                "f " + std::to_string(first) + " " + std::to_string(first + 1) + " " + std::to_string(first + 2) + "\n";
            expected.push_back(colors[used]);
        }
        const CollectedMesh mesh = meshOf(text);
        ASSERT_EQ(mesh.triangles.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            for (const std::uint64_t corner : mesh.triangles[i])
                EXPECT_EQ(mesh.colors.at(corner), expected[i]) << text;
    }
}

TEST(ObjFiles, RealOnesHaveTheCountsAndColoursOfTheirReadme) {
    const char* given = std::getenv("GNOMON_MODELS");
    const std::string files =
        (given != nullptr ? given : GNOMON_SOURCE_DIR "/../shared/models") + std::string("/formats/obj/");
    if (!std::filesystem::exists(files)) GTEST_SKIP() << "no files in " << files << " (set GNOMON_MODELS)";
    const auto trianglesByColor = [&](const std::string& name) {
        const CollectedMesh mesh = collect(*openMeshSources({files + name}, mebibytes(64)));
        std::map<std::uint32_t, std::uint64_t> counts;
        for (const TriangleCorners& triangle : mesh.triangles)
            ++counts[mesh.colors.empty() ? kUncolored : mesh.colors[triangle[0]]];
        std::multiset<std::uint64_t> sorted;
        for (const auto& [color, count] : counts)
            sorted.insert(count);
        return sorted;
    };
    // Two materials of the box, and two of the spider, have one colour.
    EXPECT_EQ(trianglesByColor("cornell_box.obj"), (std::multiset<std::uint64_t>{2, 2, 32}));
    EXPECT_EQ(trianglesByColor("box-mtllib-spaces/box mtllib.obj"), (std::multiset<std::uint64_t>{4, 4, 4}));
    EXPECT_EQ(trianglesByColor("box-missing-mtllib.obj"), (std::multiset<std::uint64_t>{12}));
    EXPECT_EQ(trianglesByColor("concave_polygon.obj"), (std::multiset<std::uint64_t>{64}));
    CollectedMesh ring = collect(*openMeshSources({files + "concave_polygon.obj"}, mebibytes(64)));
    NoProgress progress;
    ASSERT_EQ(ring.polygons.size(), 1U);
    PolygonRefiner(progress).refine(std::span(ring.triangles), [&](std::uint64_t i) { return ring.positions[i]; });
    double area = 0;
    for (const auto& [a, b, c] : ring.triangles)
        area +=
            glm::length(glm::cross(ring.positions[b] - ring.positions[a], ring.positions[c] - ring.positions[a])) / 2;
    EXPECT_NEAR(area, 0.245497, 1e-6) << "the ring has a hole, to which a bridge goes there and back";
    EXPECT_EQ(trianglesByColor("spider/spider.obj"), (std::multiset<std::uint64_t>{80, 260, 1028}));
    EXPECT_EQ(collect(*openMeshSources({files + "cube_with_vertexcolors.obj"}, mebibytes(64))).triangles.size(), 12U);
}

TEST_F(ObjWithMaterials, LinesOfALibraryMayBeContinued) {
    const std::string obj = "mtllib a.mtl\n" + kSquare + "usemtl red\nf 1 2 3\nusemtl green\nf 1 3 4\n";
    const std::set<std::uint32_t> both = {kRed, kGreen};
    for (const char* const end : {"\n", "\r\n", "\r"}) {
        std::string library;
        for (const char* const line :
             {"newmtl \\", "red", "Kd 1 \\ ", " 0 \\", "0", "# \\", "newmtl green", "Kd 0 1 0", "Ks 1 1 1 \\"})
            library += std::string(line) + end;
        writeScratch(folder + "/a.mtl", library);
        const CollectedMesh mesh = meshOf(obj);
        EXPECT_EQ(std::set(mesh.colors.begin(), mesh.colors.end()), both);
    }
    writeScratch(folder + "/a.mtl", "newmtl red\n\nKd 1 \\\n x 0\n");
    writeScratch(path, obj);
    const std::string message = errorAbout(folder, [&] { openMeshSources({path}, mebibytes(64)); });
    EXPECT_TRUE(message.starts_with("/a.mtl:3: bad colour of a material")) << message;
}

TEST_F(ObjWithMaterials, LibrariesMayBeInQuotes) {
    std::filesystem::create_directories(folder + "/sub dir");
    for (const char* const name : {"a.mtl", "my lib.mtl", "sub dir/b.mtl"})
        writeScratch(folder + "/" + name, "newmtl red\nKd 1 0 0\n");
    const auto isRed = [&](const std::string& names) {
        const CollectedMesh mesh = meshOf("mtllib " + names + "\n" + kSquare + "usemtl red\nf 1 2 3\n");
        return !mesh.colors.empty() && mesh.colors[0] == kRed;
    };
    for (const char* const names :
         {"\"a.mtl\"",
          "\"my lib.mtl\"",
          R"("gone.mtl" "a.mtl")",
          "\"A.mtl\"",
          R"("sub dir\b.mtl")",
          R"("C:\old place\a.mtl")"})
        EXPECT_TRUE(isRed(names)) << names;
    std::filesystem::remove(folder + "/a.mtl");
    EXPECT_FALSE(isRed("\"a.mtl\""));
    writeScratch(folder + "/\"a.mtl\"", "newmtl red\nKd 1 0 0\n");
    EXPECT_TRUE(isRed("\"a.mtl\"")) << "a name with quotes";
}

TEST_F(ObjWithMaterials, ALinkOutOfTheFolderIsRefused) {
    std::filesystem::create_directories(folder + "/inner");
    writeScratch(folder + "/a.mtl", "newmtl red\nKd 1 0 0\n");
    std::filesystem::create_symlink("../a.mtl", folder + "/inner/a.mtl");
    const std::string inner = folder + "/inner/a.obj";
    writeScratch(inner, "mtllib a.mtl\n" + kSquare + "usemtl red\nf 1 2 3\n");
    const std::string message = errorAbout(inner, [&] { openMeshSources({inner}, mebibytes(64)); });
    EXPECT_TRUE(message.starts_with(":1: refers to a file outside the folder of the source")) << message;
    EXPECT_EQ(
        openMeshSources({inner}, mebibytes(64), {}, Textures::Bake, folder)->summary().additionalFiles.size(), 1U);
}

} // namespace
} // namespace gnomon::read
