// Colours of a PLY in any type and under any name, the digits of its coordinates, and what else it has.
#include "preprocess/read/open_mesh_sources.h"
#include "tests/read/scratch_input.h"

#include <cstring>

namespace gnomon::read {
namespace {

class PlyColors : public ScratchInput {
protected:
    std::unique_ptr<MeshSource> opened(const std::string& text) {
        writeScratch(path + ".ply", text);
        return openMeshSources({path + ".ply"}, mebibytes(64));
    }

    void TearDown() override { std::filesystem::remove(path + ".ply"); }

    std::string remarkOf(const std::string& text) {
        const std::vector<std::string> remarks = opened(text)->summary().remarks;
        EXPECT_LE(remarks.size(), 1U);
        return remarks.empty() ? "" : remarks[0].substr(path.size() + 6);
    }
};

/// A triangle whose vertices have `properties` with the three `rows`.
std::string withVertices(const std::string& properties, const std::array<std::string, 3>& rows) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
           properties + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 " + rows[0] +
           "\n1 0 0 " + rows[1] + "\n0 1 0 " + rows[2] + "\n3 0 1 2\n";
}

std::string colorsCalled(const std::string& type, const std::array<const char*, 3>& names) {
    std::string text;
    for (const char* const name : names)
        text += "property " + type + " " + name + "\n";
    return text;
}

constexpr std::array<const char*, 3> kUsual{"red", "green", "blue"};
using Packed = std::vector<std::uint32_t>;

TEST_F(PlyColors, OfEveryTypeHaveARangeByTheirMaximum) {
    struct Row {
        const char* type;
        std::array<std::string, 3> values;
        const char* range; // of the remark, empty for none
        Packed colors;
    };

    const Packed rgb{0xFF0000FF, 0xFF00FF00, 0xFFFF0000};
    const std::vector<Row> rows = {
        {"uchar", {"255 0 0", "0 255 0", "0 0 255"}, "", rgb},
        {"char", {"-1 0 0", "0 -1 0", "0 0 -1"}, "", rgb},
        {"float", {"1 0 0", "0 1 0", "0 0 1"}, "float range from 0 to 1", rgb},
        {"float", {"255 0 0", "0 255 0", "0 0 255"}, "float range from 0 to 255", rgb},
        {"float", {"0.5 0 0", "0 0.25 0", "0 0 nan"}, "float range from 0 to 1", {0xFF000080, 0xFF004000, 0xFF000000}},
        {"double",
         {"1.5 0 0", "0 128 0", "-4 0 inf"},
         "double range from 0 to 255",
         {0xFF000002, 0xFF008000, 0xFFFF0000}},
        {"ushort", {"65535 0 0", "0 65535 0", "0 0 65535"}, "ushort range from 0 to 65535", rgb},
        {"ushort", {"255 0 0", "0 255 0", "0 0 255"}, "ushort range from 0 to 255", rgb},
        {"ushort",
         {"256 0 0", "0 32896 0", "0 0 0"},
         "ushort range from 0 to 65535",
         {0xFF000001, 0xFF008000, 0xFF000000}},
        {"short", {"32767 0 0", "0 32767 0", "0 0 32767"}, "short range from 0 to 32767", rgb},
        {"int", {"255 0 0", "0 255 0", "0 0 255"}, "int range from 0 to 255", rgb},
        {"int", {"65535 0 0", "0 65535 0", "0 0 65535"}, "int range from 0 to 65535", rgb},
        {"uint", {"4294967295 0 0", "0 4294967295 0", "0 0 4294967295"}, "uint range from 0 to 4294967295", rgb}};
    for (const Row& row : rows) {
        const std::string text = withVertices(colorsCalled(row.type, kUsual), row.values);
        EXPECT_EQ(collect(*opened(text)).colors, row.colors) << text;
        const std::string range = row.range;
        EXPECT_EQ(remarkOf(text), range.empty() ? "" : "colours of element vertex (red, green, blue) of type " + range)
            << text;
    }
}

TEST_F(PlyColors, HaveAnyUsualName) {
    for (const auto& names : std::vector<std::array<const char*, 3>>{
             kUsual,
             {"r", "g", "b"},
             {"diffuse_red", "diffuse_green", "diffuse_blue"},
             {"color_red", "color_green", "color_blue"},
             {"Red", "Green", "Blue"},
             {"R", "G", "B"}}) {
        const std::string text = withVertices(colorsCalled("uchar", names), {"255 0 0", "0 255 0", "0 0 255"});
        const auto source = opened(text);
        EXPECT_EQ(collect(*source).colors, (Packed{0xFF0000FF, 0xFF00FF00, 0xFFFF0000})) << names[0];
        EXPECT_TRUE(source->summary().attributesDropped.empty()) << names[0];
        EXPECT_EQ(source->summary().remarks.empty(), names == kUsual) << names[0];
    }
}

TEST_F(PlyColors, MayHaveAnAlphaOfItsOwnRange) {
    const std::string text = withVertices(
        colorsCalled("float", kUsual) + "property float alpha\n", {"255 0 0 1", "0 255 0 0.5", "0 0 255 0"});
    EXPECT_EQ(collect(*opened(text)).colors, (Packed{0xFF0000FF, 0x8000FF00, 0x00FF0000}));
    EXPECT_EQ(
        remarkOf(text),
        "colours of element vertex (red, green, blue) of type float range from 0 to 255, those of alpha of type float "
        "range from 0 to 1");
    EXPECT_EQ(opened(text)->summary().attributesDropped, (std::map<std::string, std::uint64_t>{{"alpha", 3}}));
}

TEST_F(PlyColors, AreTheSameInBinary) {
    const std::string ascii = withVertices(
        colorsCalled("ushort", kUsual) + "property float a\n", {"65535 0 7 1", "0 300 0 0", "9 0 255 0.5"});
    const std::string header = ascii.substr(0, ascii.find("end_header\n") + 11);
    for (const char* const format : {"binary_little_endian", "binary_big_endian"}) {
        std::string text = header;
        text.replace(text.find("ascii"), 5, format);
        const auto put = [&](const auto& value) {
            std::string bytes(sizeof value, '\0');
            std::memcpy(bytes.data(), &value, sizeof value);
            if (format[7] == 'b') std::reverse(bytes.begin(), bytes.end());
            text += bytes;
        };
        const std::array<std::array<double, 7>, 3> rows{
            {{0, 0, 0, 65535, 0, 7, 1}, {1, 0, 0, 0, 300, 0, 0}, {0, 1, 0, 9, 0, 255, 0.5}}};
        for (const auto& row : rows)
            for (std::size_t i = 0; i < row.size(); ++i)
                if (i < 3 || i == 6)
                    put(static_cast<float>(row[i]));
                else
                    put(static_cast<std::uint16_t>(row[i]));
        text += '\3';
        for (const std::int32_t corner : {0, 1, 2})
            put(corner);
        EXPECT_EQ(collect(*opened(text)), collect(*opened(ascii))) << format;
    }
}

TEST_F(PlyColors, OfFacesFollowTheSameRules) {
    const auto withFaces = [](const std::string& properties, const std::string& first, const std::string& second) {
        return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
               "element face 2\nproperty list uchar int vertex_indices\n" +
               properties + "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 " + first + "\n3 0 2 3 " + second + "\n";
    };
    const auto colorsOf = [&](const std::string& text) {
        const CollectedMesh mesh = collect(*opened(text));
        return Packed{mesh.colors.at(mesh.triangles[0][0]), mesh.colors.at(mesh.triangles[1][0])};
    };
    const Packed expected{0xFF0000FF, 0xFF00FF00};
    EXPECT_EQ(colorsOf(withFaces(colorsCalled("uchar", {"r", "g", "b"}), "255 0 0", "0 255 0")), expected);
    EXPECT_EQ(colorsOf(withFaces(colorsCalled("float", kUsual), "1 0 0", "0 1 0")), expected);
    EXPECT_EQ(colorsOf(withFaces(colorsCalled("float", kUsual), "255 0 0", "0 255 0")), expected);
    EXPECT_EQ(
        colorsOf(withFaces(
            colorsCalled("ushort", {"diffuse_red", "diffuse_green", "diffuse_blue"}), "65535 0 0", "0 65535 0")),
        expected);
    EXPECT_EQ(
        remarkOf(withFaces(colorsCalled("ushort", {"r", "g", "b"}), "9 0 0", "0 9 0")),
        "colours of element face (r, g, b) of type ushort range from 0 to 255");
}

TEST_F(PlyColors, DigitsThatAFloatDoesNotHoldAreWarnedOfOnce) {
    const auto text = [](const char* type, const std::string& place) {
        return "ply\nformat ascii 1.0\nelement vertex 4\nproperty " + std::string(type) +
               " x\nproperty float y\nproperty float z\nproperty float quality\n"
               "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 0.123456789012\n1 0 0 1\n" +
               place + " 5 0 1\n" + place + " 5 0 1\n3 0 1 2\n";
    };
    for (const char* const kept :
         {"0.1",
          "0.5",
          "500000.125",
          "0.12345678",
          "0.123456791",
          "123456.789062",
          "1e-46",
          "16777216",
          "3.4028235e38",
          "1e-20",
          "nan",
          "-0.1"})
        EXPECT_EQ(remarkOf(text("float", kept)), "") << kept;
    for (const char* const lost :
         {"500000.123", "0.1234567891", "16777217", "4649776.456", "1.000000001", "-500000.003"})
        EXPECT_EQ(
            remarkOf(text("float", lost)),
            std::string("warning: a coordinate of type float has more digits than a float holds, first \"") + lost +
                "\" of vertex 2; digits are lost, unless x, y and z are declared as double")
            << lost;
    EXPECT_EQ(remarkOf(text("double", "500000.123")), "");
}

TEST_F(PlyColors, NamesEachKindThatIsNotKept) {
    const std::string text =
        "ply\nformat ascii 1.0\nelement material 1\nproperty uchar shine\nelement vertex 3\nproperty float x\nproperty "
        "float y\n"
        "property float z\nproperty float nx\nproperty float ny\nproperty uchar red\nproperty uchar green\n"
        "property float s\nproperty float t\nproperty float quality\nproperty list uchar int seen_by\n"
        "element face 2\nproperty list uchar int vertex_indices\nproperty float x\nproperty uchar flags\n"
        "property uchar diffuse_red\nproperty list uchar float texcoord\n"
        "element edge 2\nproperty int vertex1\nproperty int vertex2\nelement empty 5\nelement none 0\nproperty int "
        "a\nend_header\n"
        "7\n0 0 0 0 1 9 9 0 0 1 1 5\n1 0 0 0 1 9 9 0 0 1 0\n0 1 0 0 1 9 9 0 0 1 2 1 2\n3 0 1 2 4 1 200 0\n3 2 1 0 4 1 "
        "200 1 5\n0 1\n1 2\n";
    const std::map<std::string, std::uint64_t> expected = {
        {"element edge", 2},
        {"element empty", 5},
        {"element material", 1},
        {"face diffuse_red", 2},
        {"face flags", 2},
        {"face x", 2},
        {"texture coordinates", 5},
        {"vertex green", 3},
        {"vertex nx", 3},
        {"vertex ny", 3},
        {"vertex quality", 3},
        {"vertex red", 3},
        {"vertex seen_by", 3}};
    const auto source = opened(text);
    EXPECT_EQ(source->summary().attributesDropped, expected);
    EXPECT_EQ(collect(*source).triangles.size(), 2U);
}

TEST_F(PlyColors, HeadersOfOtherEncodingsAreToldApart) {
    const std::string text = withVertices("", {"", "", ""});
    EXPECT_EQ(collect(*opened("\xEF\xBB\xBF" + text)).triangles.size(), 1U);
    std::string wide = "\xFF\xFE";
    for (const char c : text)
        wide += {c, '\0'};
    EXPECT_EQ(errorAbout(path + ".ply", [&] { opened(wide); }), ": the text is in UTF-16; convert to UTF-8");
}

} // namespace
} // namespace gnomon::read
