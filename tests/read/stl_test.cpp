// STL, ASCII and binary, with the colours of two programs; damaged files as one error with its line or byte.
#include "core/random.h"
#include "preprocess/read/stl/stl_source.h"
#include "tests/read/scratch_input.h"

#include <cstring>

namespace gnomon::read {
namespace {

class Stl : public ScratchInput {
protected:
    std::unique_ptr<MeshSource> opened(const std::string& text) {
        writeScratch(path, text);
        return readStl(path, mebibytes(64));
    }

    CollectedMesh read(const std::string& text) { return collect(*opened(text)); }

    std::string errorOf(const std::string& text) {
        return errorAbout(path, [&] { read(text); });
    }
};

struct Facet {
    std::array<float, 9> corners{};
    std::uint16_t attribute = 0;
    glm::vec3 normal{0};
};

std::string binaryStl(const std::vector<Facet>& facets, const std::string& header = "") {
    std::string bytes = header + std::string(80 - header.size(), ' ');
    const auto count = static_cast<std::uint32_t>(facets.size());
    bytes.append(reinterpret_cast<const char*>(&count), 4);
    for (const Facet& facet : facets) {
        bytes.append(reinterpret_cast<const char*>(&facet.normal), 12);
        bytes.append(reinterpret_cast<const char*>(facet.corners.data()), 36);
        bytes.append(reinterpret_cast<const char*>(&facet.attribute), 2);
    }
    return bytes;
}

constexpr std::array<float, 9> kLow{0, 0, 0, 1, 0, 0, 1, 1, 0};
constexpr std::array<float, 9> kHigh{0, 0, 0, 1, 1, 0, 0, 1, 0};

const std::string kText = "solid outerwall\n"
                          "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 1 1 0\n"
                          " endloop\nendfacet\n"
                          "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 1 0\n  vertex 0 1 0\n"
                          " endloop\nendfacet\n"
                          "endsolid\n";

/// `text` in one line.
std::string inOneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

TEST_F(Stl, AsciiAndBinaryAgree) {
    const CollectedMesh text = read(kText);
    EXPECT_EQ(text.triangles, (std::vector<TriangleCorners>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(text.positions, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(read(binaryStl({{kLow}, {kHigh}})), text);
    EXPECT_EQ(read(binaryStl({{kLow}, {kHigh}}, "solid that is binary")), text);
    const std::string other = "solid two facet of a part\n" + kText.substr(kText.find('\n') + 1);
    std::string upper = kText;
    std::transform(
        upper.begin(), upper.end(), upper.begin(), [](char c) { return c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c; });
    for (const std::string& same :
         {inOneLine(kText),
          upper,
          "\xEF\xBB\xBF" + kText,
          "\n  " + kText,
          other,
          kText + "\n\n",
          inOneLine(kText) + "\n"})
        EXPECT_EQ(read(same), text) << same;
}

TEST_F(Stl, MayHaveSeveralSolids) {
    const std::string first = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 "
                              "0\nendloop\nendfacet\nendsolid a\n";
    const std::string second = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 "
                               "0\nendloop\nendfacet\nendsolid\n";
    const CollectedMesh both = read(first + second);
    EXPECT_EQ(both.triangles.size(), 2U);
    EXPECT_EQ(both.positions.size(), 4U);
    EXPECT_EQ(read(inOneLine(first + second)), both);
    EXPECT_EQ(read("solid empty\nendsolid my solid\n" + first + second), both);
    EXPECT_EQ(read(inOneLine("solid empty endsolid empty " + first + second)), both);
}

TEST_F(Stl, KeepsTheDigitsOfTheText) {
    const CollectedMesh mesh =
        read("solid s\nfacet normal 0 0 1\nouter loop\nvertex 500000.003 4649776.4561 1e-46\nvertex 0.1 -2.5e-320 3\n"
             "vertex -0 +2 1e300\nendloop\nendfacet\nendsolid s\n");
    EXPECT_EQ(
        mesh.positions,
        (std::vector<glm::dvec3>{{500000.003, 4649776.4561, 1e-46}, {0.1, -2.5e-320, 3}, {0, 2, 1e300}}));
}

TEST_F(Stl, CornersAtOnePlaceAreOneVertex) {
    Random random(5);
    std::vector<Facet> facets(4000);
    for (Facet& facet : facets)
        for (float& value : facet.corners)
            value = static_cast<float>(random.below(9)) - 4 == 0 && random.below(2) == 0
                        ? -0.0F
                        : static_cast<float>(random.below(9)) - 4;
    const CollectedMesh mesh = read(binaryStl(facets));
    std::map<std::array<float, 3>, std::uint64_t> places;
    std::size_t triangle = 0;
    std::uint64_t none = 0;
    for (const Facet& facet : facets) {
        TriangleCorners corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::array<float, 3> place{
                facet.corners[3 * i] + 0, facet.corners[3 * i + 1] + 0, facet.corners[3 * i + 2] + 0};
            corners[i] = places.try_emplace(place, places.size()).first->second;
        }
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
            ++none;
        else
            ASSERT_EQ(mesh.triangles.at(triangle++), corners);
    }
    EXPECT_EQ(mesh.positions.size(), places.size());
    EXPECT_EQ(mesh.notAPolygon, none);
    EXPECT_GT(none, 0U);
}

/// The colour of each triangle, which all its corners have.
std::vector<std::uint32_t> colorsOf(const CollectedMesh& mesh) {
    std::vector<std::uint32_t> colors;
    for (const TriangleCorners& triangle : mesh.triangles) {
        colors.push_back(mesh.colors.at(triangle[0]));
        for (const std::uint64_t corner : triangle)
            EXPECT_EQ(mesh.colors[corner], colors.back());
    }
    return colors;
}

TEST_F(Stl, HasColoursInTheMannerOfVisCam) {
    using Colors = std::vector<std::uint32_t>;
    constexpr std::uint16_t kValid = 0x8000;
    EXPECT_EQ(
        colorsOf(read(binaryStl({{kLow, kValid | 31 << 10}, {kHigh, kValid | 31 << 5}}))),
        (Colors{0xFF0000FF, 0xFF00FF00}));
    const auto source = opened(binaryStl({{kLow, kValid | 31}, {kHigh, 31}, {kHigh, kValid | 16 << 10}}));
    EXPECT_EQ(colorsOf(collect(*source)), (Colors{0xFFFF0000, 0xFFFFFFFF, 0xFF000084}));
    EXPECT_EQ(source->summary().attributesDropped.at("attribute bytes that are no colour"), 1U);
    ASSERT_EQ(source->summary().remarks.size(), 1U);
    EXPECT_NE(source->summary().remarks[0].find("VisCAM"), std::string::npos);
}

TEST_F(Stl, HasColoursInTheMannerOfMagics) {
    using Colors = std::vector<std::uint32_t>;
    const std::string header = "made by a program COLOR=\x10\x20\x30\xFF and more";
    constexpr std::uint16_t kOfPart = 0x8000;
    EXPECT_EQ(
        colorsOf(
            read(binaryStl({{kLow, 31}, {kHigh, 31 << 5}, {kLow, 31 << 10}, {kHigh, kOfPart}, {kHigh, 0}}, header))),
        (Colors{0xFF0000FF, 0xFF00FF00, 0xFFFF0000, 0xFF302010, 0xFF000000}));
    EXPECT_EQ(colorsOf(read(binaryStl({{kLow}, {kHigh}}, header))), (Colors{0xFF302010, 0xFF302010}))
        << "all zero is a program that knows of no facets with colours";
    EXPECT_TRUE(read(binaryStl({{kLow}, {kHigh}}, std::string(75, ' ') + "COLOR")).colors.empty());
}

TEST_F(Stl, NamesEachKindThatIsNotKept) {
    using Dropped = std::map<std::string, std::uint64_t>;
    EXPECT_EQ(opened(binaryStl({{kLow}, {kHigh, 0, {0, 0, 1}}}))->summary().attributesDropped, Dropped{});
    EXPECT_EQ(
        opened(binaryStl({{kLow, 5, {0, 1, 0}}, {kHigh, 0, {0, 0, -1}}}))->summary().attributesDropped,
        (Dropped{{"attribute bytes that are no colour", 1}, {"normals unlike those of their facets", 2}}));
    EXPECT_EQ(
        opened(binaryStl({{kLow, 1}}, "COLOR=abcd,MATERIAL=abcdefghijkl"))->summary().attributesDropped,
        (Dropped{{"MATERIAL= of the header", 1}}));
    std::string text = kText;
    text.replace(text.find("normal 0 0 1"), 12, "normal 0 1 0");
    text.insert(text.find(" endloop"), "color 1 0 0\n");
    EXPECT_EQ(
        opened(text)->summary().attributesDropped,
        (Dropped{{"colours of facets in ASCII", 1}, {"normals unlike those of their facets", 1}}));
    EXPECT_EQ(opened(kText)->summary().attributesDropped, Dropped{});
}

TEST_F(Stl, ErrorsNameThePlace) {
    const std::string binary = binaryStl({{kLow}});
    EXPECT_EQ(
        errorOf(binary.substr(0, 120)),
        ": byte 120: neither ascii nor binary STL: expected 134 bytes for 1 facets, found 120");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(errorOf(binaryStl({{{0, 0, 0, 1, 0, nan, 1, 1, 0}}})), ": byte 116: a coordinate is not finite");
    EXPECT_EQ(errorOf(kText.substr(0, kText.size() - 9)), ":15: the file ends too early: no endsolid");
    EXPECT_EQ(errorOf(kText.substr(0, kText.find("  vertex 1 0 0"))), ":4: the file ends too early: no endsolid");
    EXPECT_EQ(
        errorOf("solid x\nouter loop\nvertex 0 0 0\nendloop\nendsolid\n"),
        R"(:4: bad loop: expected three vertices, found "endloop")");
    EXPECT_EQ(
        errorOf("solid x\nvertex 0 0 0\n"), ":2: a vertex is outside a loop, or the loop has more than three vertices");
    EXPECT_EQ(errorOf("solid x\nfaces 3\n"), R"(:2: unknown STL keyword: "faces")");
    EXPECT_EQ(errorOf("solid x\nouter loop\nvertex 0 x 0\n"), R"(:3: not a number: expected a number, found "x")");
    EXPECT_EQ(errorOf("solid x\nouter loop\nvertex 0 inf 0\nvertex"), ":3: a coordinate is not finite");
    EXPECT_EQ(errorOf("solid x\nendsolid\n"), ": empty: it has no vertices and no faces");
    EXPECT_EQ(errorOf(std::string("s\0o\0l\0i\0d\0 \0x\0", 14)), ": the text is in UTF-16; convert to UTF-8");
    EXPECT_NE(errorOf("solid x " + std::string(100'000, 'n')), "no error");
    const std::string isLong = ": a word is longer than 1000 characters: expected a number or a keyword, found ";
    EXPECT_NE(
        errorOf("solid x\nouter loop\nvertex 0 " + std::string(1001, '1') + " 0\n").find(":3" + isLong),
        std::string::npos);
    EXPECT_NE(errorOf("solid x\n" + std::string(2000, 'n')).find(":2" + isLong), std::string::npos);
}

TEST_F(Stl, MutatedFilesGiveAMeshOrAnError) {
    const std::vector<std::string> seeds = {
        kText, inOneLine(kText), binaryStl({{kLow, 0x8001}, {kHigh}}), binaryStl({{kLow, 1}, {kHigh}}, "COLOR=abcd")};
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
