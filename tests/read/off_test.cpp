// OFF in all the ways that programs write it; damaged files as one error with its line or byte.
#include "core/random.h"
#include "preprocess/read/off/off_source.h"
#include "preprocess/read/open_mesh_sources.h"
#include "tests/read/scratch_input.h"

#include <cstring>
#include <fstream>

namespace gnomon::read {
namespace {

class Off : public ScratchInput {
protected:
    std::unique_ptr<MeshSource> opened(const std::string& text) {
        writeScratch(path, text);
        return readOff(path, mebibytes(64));
    }

    CollectedMesh read(const std::string& text) { return collect(*opened(text)); }

    std::string errorOf(const std::string& text) {
        return errorAbout(path, [&] { read(text); });
    }
};

const std::string kBody = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n";
const std::vector<glm::dvec3> kPlaces{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<TriangleCorners> kTriangles{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}};

TEST_F(Off, HasAHeaderOfAnyShape) {
    for (const char* const header :
         {"OFF\n4 2 0\n",
          "OFF 4 2 0\n",
          "OFF4 2 0\n",
          "OFF4\n2\n0\n",
          "OFF\n4\n2\n0\n",
          "OFF\n4 2\n0\n",
          "OFF\n4 2\n",
          "OFF4 2\n",
          "# a comment\nOFF\n4 2 0\n",
          "\n \n#\n# two\n\nOFF # here\n\n# and here\n4 2 0 # edges\n\n",
          "off\r\n4 2 0\r\n",
          "4 2 0\n",
          "\xEF\xBB\xBFOFF\n4 2 0\n",
          "OFF\t4\t2\t6\n",
          "  OFF\n4 2 0\n"}) {
        const CollectedMesh mesh = read(header + kBody);
        EXPECT_EQ(mesh.positions, kPlaces) << header;
        EXPECT_EQ(mesh.triangles, kTriangles) << header;
    }
    EXPECT_EQ(errorOf("OF\n1 1 0\n").substr(0, 52), ":1: not an OFF file with three coordinates per verte");
    for (const char* const header : {"4OFF\n", "nOFF\n", "OFFSET\n", "ply\n", "v\n"})
        EXPECT_NE(errorOf(header + kBody), "no error") << header;
}

TEST_F(Off, MayBreakItsLinesAnywhere) {
    for (const char* const text :
         {"OFF\n4 2 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n3 0 1 2\n4 0 1 2 3\n",
          "OFF\n4 2 0\n0\n0\n0 1 0\n0 1\n1 0 0 1 0\n3 0 1 2\n4 0 1 2 3\n",
          "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 4 0 1 2 3\n",
          "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0\n1 2\n4\n0 1 2 3\n",
          "OFF 4 2 0 0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2 4 0 1 2 3",
          "OFF\n4 2 0 0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3"}) {
        const CollectedMesh mesh = read(text);
        EXPECT_EQ(mesh.positions, kPlaces) << text;
        EXPECT_EQ(mesh.triangles, kTriangles) << text;
        EXPECT_TRUE(mesh.colors.empty()) << text;
    }
    const CollectedMesh wrapped = read("OFF\n3 1 0\n0 0 0 1\n0 0 0 1 0\n3 0 1 2 255 0 0\n");
    EXPECT_EQ(wrapped.colors, std::vector<std::uint32_t>(3, 0xFF0000FF)) << "faces have lines";
    EXPECT_EQ(
        read("COFF 3 1 0 0 0 0 255 0 0 255 1 0 0 0 255 0 255 0 1 0 0 0 255 255 3 0 1 2").colors,
        (std::vector<std::uint32_t>{0xFF0000FF, 0xFF00FF00, 0xFFFF0000}));
    EXPECT_EQ(
        read("NCOFF 3 1 0 0 0 0 0 0 1 255 0 0 1 0 0 0 0 1 0 255 0 0 1 0 0 0 1 0 0 255 3 0 1 2").colors,
        (std::vector<std::uint32_t>{0xFF0000FF, 0xFF00FF00, 0xFFFF0000}));
}

TEST_F(Off, KeepsTheDigitsOfTheText) {
    const CollectedMesh mesh = read("OFF\n3 1 0\n500000.003 4649776.4561 1e-46\n0.1 -2.5e-320 1e300\n1 2 3\n3 0 1 2\n");
    EXPECT_EQ(
        mesh.positions,
        (std::vector<glm::dvec3>{{500000.003, 4649776.4561, 1e-46}, {0.1, -2.5e-320, 1e300}, {1, 2, 3}}));
}

TEST_F(Off, HasNormalsAndColorsOfVertices) {
    const CollectedMesh mesh =
        read("CNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0 255\n1 0 0 0 1 0 0 255 0 255\n0 1 0 1 0 0 0 0 255 128\n3 0 1 2\n");
    EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}));
    EXPECT_EQ(mesh.colors, (std::vector<std::uint32_t>{0xFF0000FF, 0xFF00FF00, 0x80FF0000}));
    const std::vector<std::uint32_t> rgb{0xFF0000FF, 0xFF00FF00, 0xFFFF0000};
    const auto colorsOf = [&](const std::string& header, const char* red, const char* green, const char* blue) {
        return read(header + "\n3 1 0\n0 0 0 " + red + "\n1 0 0 " + green + "\n0 1 0 " + blue + "\n3 0 1 2\n").colors;
    };
    for (const char* const header : {"OFF", "COFF"}) {
        EXPECT_EQ(colorsOf(header, "255 0 0", "0 255 0", "0 0 255"), rgb);
        EXPECT_EQ(colorsOf(header, "255 0 0 255", "0 255 0 255", "0 0 255 255"), rgb);
        EXPECT_EQ(colorsOf(header, "1.0 0 0", "0 1.0 0", "0 0 1.0 1"), rgb);
        EXPECT_EQ(colorsOf(header, "255.0 0 0", "0 255.0 0", "0 0 255.0"), rgb);
        EXPECT_EQ(
            colorsOf(header, "1 0.5 0", "0 0.5 0 0.5", "0 0 0.0"),
            (std::vector<std::uint32_t>{0xFF0080FF, 0x80008000, 0xFF000000}));
    }
    EXPECT_EQ(colorsOf("STCOFF", "255 0 0 0.5 0.5", "0 255 0 0.5 0.5", "0 0 255 0.5 0.5"), rgb);
    EXPECT_EQ(colorsOf("OFF", "255 0 0", "", ""), (std::vector<std::uint32_t>{0xFF0000FF, 0xFFFFFFFF, 0xFFFFFFFF}));
}

TEST_F(Off, HasColorsOfFacesWhereVerticesHaveNone) {
    const std::string text = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    const auto colorsOf = [&](const std::string& faces) {
        const CollectedMesh mesh = read(text + faces);
        std::vector<std::uint32_t> colors;
        for (const TriangleCorners& triangle : mesh.triangles) {
            colors.push_back(mesh.colors.at(triangle[0]));
            for (const std::uint64_t corner : triangle)
                EXPECT_EQ(mesh.colors[corner], colors.back());
        }
        return colors;
    };
    using Colors = std::vector<std::uint32_t>;
    EXPECT_EQ(colorsOf("3 0 1 2 255 0 0\n3 0 2 3 0 255 0\n"), (Colors{0xFF0000FF, 0xFF00FF00}));
    EXPECT_EQ(colorsOf("3 0 1 2 255 0 0 128\n3 0 2 3\n"), (Colors{0x800000FF, 0xFFFFFFFF}));
    EXPECT_EQ(colorsOf("3 0 1 2 255 0 0\n3 0 2 3 0.5 0 0 1\n"), (Colors{0xFF0000FF, 0xFF000001})) << "one rule";
    EXPECT_EQ(colorsOf("3 0 1 2 1 0 0\n3 0 2 3 0 0.5 0\n"), (Colors{0xFF0000FF, 0xFF008000}));
    EXPECT_EQ(colorsOf("3 0 1 2 1 0 0\n3 0 2 3 0 1 1\n"), (Colors{0xFF0000FF, 0xFFFFFF00}));
    EXPECT_EQ(colorsOf("3 0 1 2 1.0 0.0 0.0\n3 0 2 3 0.0 1.0 0.0\n"), (Colors{0xFF0000FF, 0xFF00FF00}));
}

TEST_F(Off, OneRuleHoldsForAllColours) {
    struct Row {
        const char* keyword;
        std::array<const char*, 3> colors;
        std::vector<std::uint32_t> expected;
        const char* remark; // empty for none
        std::uint64_t alpha;
    };

    const std::vector<std::uint32_t> rgb{0xFF0000FF, 0xFF00FF00, 0xFFFF0000};
    const char* const ofOne = ": colours of vertices range from 0 to 1, because none exceeds 1";
    const std::vector<Row> rows = {
        {"COFF", {"1 0 0 1", "0 0.5 0 1", "0 0 1 1"}, {0xFF0000FF, 0xFF008000, 0xFFFF0000}, ofOne, 0},
        {"COFF", {"1 0 0 1", "0 1 0 1", "0 0 1 1"}, rgb, ofOne, 0},
        {"OFF", {"1 0 0", "0 1 0", "0 0 1"}, rgb, ofOne, 0},
        {"COFF", {"1 0 0 0.5", "0 1 0 1", "0 0 1 0"}, {0x800000FF, 0xFF00FF00, 0x00FF0000}, ofOne, 2},
        {"COFF", {"255 0 0 128", "0 255 0 255", "0 0 1 255"}, {0x800000FF, 0xFF00FF00, 0xFF010000}, "", 1},
        {"COFF", {"255 0 0 1", "0 255 0 1", "0 0 255 1"}, rgb, "", 0},
        {"OFF",
         {"254.6 0 0", "0 1 0", "0 0 0"},
         {0xFF0000FF, 0xFF000100, 0xFF000000},
         ": colours of vertices, which are real numbers, range from 0 to 255, because one exceeds 1",
         0}};
    for (const Row& row : rows) {
        const auto source = opened(
            std::string(row.keyword) + "\n3 1 0\n0 0 0 " + row.colors[0] + "\n1 0 0 " + row.colors[1] + "\n0 1 0 " +
            row.colors[2] + "\n3 0 1 2\n");
        EXPECT_EQ(collect(*source).colors, row.expected) << row.colors[0];
        const std::vector<std::string>& remarks = source->summary().remarks;
        EXPECT_EQ(remarks.empty() ? "" : remarks[0], *row.remark == 0 ? "" : path + row.remark);
        const auto& dropped = source->summary().attributesDropped;
        EXPECT_EQ(dropped.contains("alpha") ? dropped.at("alpha") : 0, row.alpha) << row.colors[0];
    }
    const auto source = opened("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0 128\n3 2 1 0 0 0 0 255\n");
    EXPECT_EQ(source->summary().attributesDropped, (std::map<std::string, std::uint64_t>{{"alpha", 1}}));
}

TEST_F(Off, NamesEachKindThatIsNotKept) {
    using Dropped = std::map<std::string, std::uint64_t>;
    EXPECT_EQ(
        opened("STNOFF\n4 4 0\n0 0 0 0 0 1 0 0\n1 0 0 nan 0 0 0 0\n1 1 0 0 0 1 0 0 9\n0 1 0 0 0 1 0 0 255 0 0\n"
               "3 0 1 2 255 0 0\n3 0 1 2 7\n3 0 1 2 1 2\n3 0 1 2\n")
            ->summary()
            .attributesDropped,
        (Dropped{
            {"face colours", 1},
            {"face colours by their numbers in a table", 1},
            {"normals that are not finite", 1},
            {"other values of faces", 1},
            {"other values of vertices", 1},
            {"texture coordinates", 4}}));
    EXPECT_EQ(
        opened("OFF\n3 1 0\n0 0 0 0 0 -1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n")->summary().attributesDropped,
        (Dropped{{"other values of vertices", 3}}))
        << "below zero is no colour";
    EXPECT_EQ(opened("OFF\n4 2 0\n" + kBody)->summary().attributesDropped, Dropped{});
}

TEST_F(Off, ErrorsNameTheLine) {
    const std::string text = "OFF 4 2 0\n# points\n0 0 0\n1 0 0\n\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3";
    EXPECT_EQ(errorOf(text), "no error");
    EXPECT_EQ(
        errorOf(text.substr(0, text.find("4 0 1"))),
        ":8: the file ends too early: expected 0 more vertices and 1 more faces, found the end");
    EXPECT_EQ(
        errorOf(text.substr(0, text.size() - 1)),
        ":9: bad face: expected a number of corners and as many indices, found 4 words");
    EXPECT_EQ(errorOf(text + "\n3 0 1 2"), ":10: data after the last face: the counts are too small");
    EXPECT_EQ(
        errorOf("OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 3\n"),
        ":6: vertex index out of range: expected one of 3 vertices, found index 3 counted from 0");
    EXPECT_NE(errorOf("OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 -1\n").find(":6: vertex index"), std::string::npos);
    EXPECT_NE(errorOf("OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 x\n").find(":6: bad face"), std::string::npos);
    EXPECT_NE(errorOf("OFF\n3 1 0\n0 0 0\n1 x 0\n1 1 0\n3 0 1 2\n").find(":4: not a number"), std::string::npos);
    EXPECT_NE(
        errorOf("OFF\n3 1 0\n0 0 0\n1 1e400 0\n1 1 0\n3 0 1 2\n").find(":4: the number is too"), std::string::npos);
    EXPECT_EQ(errorOf("OFF\n3 1 0\n0 0 0\n1 0 nan\n1 1 0\n3 0 1 2\n"), ":4: a coordinate of vertex 1 is not finite");
    EXPECT_EQ(errorOf("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\nnan 0 0\n3 0 1 2\n"), "no error") << "nobody uses it";
    for (const char* const bad : {"3", "3 1 0 0", "3 -1 0", "3 1 x", "18446744073709551616 1 0", "x"})
        EXPECT_NE(errorOf("OFF\n" + std::string(bad) + "\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n"), "no error") << bad;
    EXPECT_NE(
        errorOf("OFF\n3 4000000000 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n")
            .find("the file is too short for the counts of its header"),
        std::string::npos);
    EXPECT_NE(
        errorOf("OFF\n4000000000000000000 1 0\n0 0 0\n").find("the file is too short for the counts of its header"),
        std::string::npos);
    EXPECT_NE(
        errorOf("OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n4000000000 0 1 2\n").find("the face has too many corners"),
        std::string::npos);
    EXPECT_NE(errorOf("COFF\n1 1 0\n0 0 0 1 1\n3 0 0 0\n").find("a colour of three or four"), std::string::npos);
    const std::string longNumber = "1." + std::string(1000, '3');
    const std::string isLong = ": a word is longer than 1000 characters: expected a number or a keyword, found \"1.333";
    EXPECT_NE(
        errorOf("OFF\n3 1 0\n0 0 0\n" + longNumber + " 0 0\n1 1 0\n3 0 1 2\n").find(":4" + isLong), std::string::npos);
    EXPECT_NE(
        errorOf("OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 " + longNumber + "\n").find(":6" + isLong), std::string::npos);
    EXPECT_NE(errorOf("OFF\n" + longNumber + " 1 0\n").find(":2" + isLong), std::string::npos);
    EXPECT_EQ(errorOf("OFF\n3 1 0\n0 0 0\n1." + std::string(998, '3') + " 0 0\n1 1 0\n3 0 1 2\n"), "no error");
    EXPECT_EQ(errorOf("\xFF\xFEO"), ": the text is in UTF-16; convert to UTF-8");
}

std::string ofNumbers(const std::vector<std::uint32_t>& numbers, bool isBigEndian) {
    std::string bytes;
    for (const std::uint32_t number : numbers)
        for (std::uint32_t i = 0; i < 4; ++i)
            bytes += static_cast<char>(number >> (8 * (isBigEndian ? 3 - i : i)));
    return bytes;
}

std::string binaryOff(bool isBigEndian, bool countsChannels) {
    const std::uint32_t one = 0x3F800000; // 1 as a float
    std::vector<std::uint32_t> numbers{3, 2, 0, 0, 0, 0, one, 0, 0, 0, one, 0, 3, 0, 1, 2};
    if (countsChannels) numbers.insert(numbers.end(), {4, one, 0, 0, one});
    numbers.insert(numbers.end(), {3, 2, 1, 0});
    if (countsChannels) numbers.push_back(0);
    return "OFF BINARY\n" + ofNumbers(numbers, isBigEndian);
}

TEST_F(Off, MayBeBinary) {
    for (const bool isBigEndian : {false, true})
        for (const bool countsChannels : {false, true}) {
            const auto source = opened(binaryOff(isBigEndian, countsChannels));
            const CollectedMesh mesh = collect(*source);
            const std::array<glm::dvec3, 3> places{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
            ASSERT_EQ(mesh.triangles.size(), 2U);
            for (std::size_t i = 0; i < 3; ++i) {
                EXPECT_EQ(mesh.positions[mesh.triangles[0][i]], places[i]);
                EXPECT_EQ(mesh.positions[mesh.triangles[1][i]], places[2 - i]);
                if (!countsChannels) continue;
                EXPECT_EQ(mesh.colors[mesh.triangles[0][i]], 0xFF0000FF);
                EXPECT_EQ(mesh.colors[mesh.triangles[1][i]], 0xFFFFFFFF);
            }
            EXPECT_EQ(mesh.colors.empty(), !countsChannels);
            EXPECT_TRUE(source->summary().attributesDropped.empty());
        }
    EXPECT_NE(errorOf(binaryOff(true, true) + "x"), "no error");
    EXPECT_NE(errorOf(binaryOff(true, true).substr(0, 60)).find(": byte "), std::string::npos);
}

TEST_F(Off, TooLargeForTheMemoryIsSaidBeforeReading) {
    std::ofstream(path) << "OFF\n4 2 0\n" + kBody;
    std::filesystem::resize_file(path, std::uint64_t{1} << 32U);
    const std::string message = errorAbout(path, [&] { readOff(path, gibibytes(2)); });
    EXPECT_NE(message.find("too large: this format is read into memory as a whole"), std::string::npos) << message;
}

TEST_F(Off, MutatedFilesGiveAMeshOrAnError) {
    const std::vector<std::string> seeds = {
        "OFF\n4 2 0\n" + kBody,
        "OFF4 2\n0 0 0 1 0 0\n1 1 0 0 1 0\n3 0 1 2\n4 0 1 2 3\n",
        "CNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0\n1 0 0 0 1 0 0 255 0\n0 1 0 1 0 0 0 0 255\n3 0 1 2 1 1 0\n",
        binaryOff(true, true),
        binaryOff(false, false)};
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        Random random(seed);
        std::string text = seeds[seed % seeds.size()];
        if (random.below(4) == 0) text.resize(random.below(text.size()));
        for (std::uint64_t n = random.below(4); n > 0 && !text.empty(); --n)
            text[random.below(text.size())] = static_cast<char>(
                random.below(2) == 0 ? random.bits() : static_cast<unsigned char>("/ -0.9\n#"[random.below(8)]));
        errorOf(text);
    }
    for (const std::string& good : seeds)
        EXPECT_EQ(errorOf(good), "no error") << good;
}

} // namespace
} // namespace gnomon::read
