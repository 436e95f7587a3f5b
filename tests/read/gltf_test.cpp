// glTF: real files against the counts, bounds and areas that their README gives, small made ones whose answer is plain,
// and damaged ones.
#include "core/random.h"
#include "preprocess/read/gltf/gltf_file.h"
#include "preprocess/read/gltf/gltf_source.h"
#include "preprocess/read/open_mesh_sources.h"
#include "tests/read/collect.h"
#include "tests/support/gltf_maker.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <sstream>

#include <nlohmann/json.hpp>
#include <unistd.h>

namespace gnomon::read {
namespace {

using nlohmann::json;

std::string formatsFolder() {
    const char* given = std::getenv("GNOMON_MODELS");
    return (given != nullptr ? given : GNOMON_SOURCE_DIR "/../shared/models") + std::string("/formats");
}

#define SKIP_WITHOUT_FORMATS()                                                                                         \
    if (!std::filesystem::exists(formatsFolder() + "/README.md"))                                                      \
    GTEST_SKIP() << "no files in " << formatsFolder() << " (set GNOMON_MODELS)"

struct Shape {
    std::uint64_t triangles = 0;
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    double area = 0;
};

Shape shapeOf(const CollectedMesh& mesh) {
    Shape shape;
    shape.triangles = mesh.triangles.size();
    for (const TriangleCorners& triangle : mesh.triangles) {
        std::array<glm::dvec3, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = mesh.positions[triangle[k]];
            shape.low = glm::min(shape.low, corners[k]);
            shape.high = glm::max(shape.high, corners[k]);
        }
        shape.area += glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0])) / 2;
    }
    return shape;
}

/// The rows of the README's first table: file, triangles, bounds and area.
std::vector<std::pair<std::string, Shape>> gltfTable() {
    const auto point = [](const std::string& text) {
        glm::dvec3 p{};
        EXPECT_EQ(std::sscanf(text.c_str(), " (%lf, %lf, %lf)", &p.x, &p.y, &p.z), 3) << text;
        return p;
    };
    std::vector<std::pair<std::string, Shape>> rows;
    std::ifstream readme(formatsFolder() + "/README.md");
    bool isGltf = false;
    for (std::string line; std::getline(readme, line);) {
        if (line.starts_with("## ")) isGltf = line == "## glTF to read";
        std::vector<std::string> cells;
        std::istringstream rest(line);
        for (std::string cell; std::getline(rest, cell, '|');)
            cells.push_back(cell);
        if (!isGltf || cells.size() < 7 || cells[4].find('(') == std::string::npos) continue;
        std::erase(cells[3], ',');
        rows.push_back(
            {cells[1].substr(1, cells[1].size() - 2),
             {std::stoull(cells[3]), point(cells[4]), point(cells[5]), std::stod(cells[6])}});
    }
    return rows;
}

TEST(ReadGltf, RealFilesHaveTheCountsBoundsAndAreasOfTheirReadme) {
    SKIP_WITHOUT_FORMATS();
    const auto rows = gltfTable();
    ASSERT_EQ(rows.size(), 22U);
    for (const auto& [name, expected] : rows) {
        SCOPED_TRACE(name);
        if (expected.triangles > 2'000'000) continue; // below
        const Shape shape = shapeOf(collect(*openMeshSources({formatsFolder() + "/gltf/" + name}, gibibytes(1))));
        EXPECT_EQ(shape.triangles, expected.triangles);
        const double within = 2e-6 * glm::length(expected.high - expected.low) + 1e-12;
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(shape.low[i], expected.low[i], within);
            EXPECT_NEAR(shape.high[i], expected.high[i], within);
        }
        EXPECT_NEAR(shape.area, expected.area, 1e-6 * expected.area);
    }
}

TEST(ReadGltf, InstancesTakeNoMemoryOfTheirOwn) {
    SKIP_WITHOUT_FORMATS();
    const auto source =
        openMeshSources({formatsFolder() + "/gltf/24_gpu_instancing/24_gpu_instancing.gltf"}, mebibytes(8));
    EXPECT_EQ(source->summary().faceCount, 7'656'770U);
    EXPECT_LT(source->summary().heldBytes, mebibytes(2).count);
    std::uint64_t triangles = 0;
    source->readTriangles([&](const TriangleBlock& block) { triangles += block.triangles.size(); });
    EXPECT_EQ(triangles, 7'656'770U);
}

TEST(ReadGltf, WhatIsNotReadIsRefusedInALineThatNamesIt) {
    SKIP_WITHOUT_FORMATS();
    const std::vector<std::pair<std::string, std::string>> files = {
        {"DenseSphere_draco.glb", "KHR_draco_mesh_compression"},
        {"BoxDraco/BoxDraco.gltf", "KHR_draco_mesh_compression"},
        {"RecursiveNodes.gltf", "cycle"},
        {"IndexOutOfRange/IndexOutOfRange.gltf", "accessor 0: index out of range"},
        {"box.3mf", "3MF is not read"},
        {"box.fbx", "FBX is not read"},
        {"simpleShading.usda", "USD is not read"},
        {"1.2_0.las", "LAS is points"}};
    for (const auto& [name, words] : files) {
        const std::string path = formatsFolder() + "/refuse/" + name;
        const std::string message = errorAbout(path, [&] { collect(*openMeshSources({path}, gibibytes(1))); });
        EXPECT_NE(message.find(words), std::string::npos) << name << message;
    }
}

constexpr std::int64_t kMany = std::int64_t{1} << 40; // what no file here has

const std::vector<float> kTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};

class ReadMadeGltf : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove(path); }

    CollectedMesh meshOf(GltfMaker& maker, Textures textures = Textures::Bake) {
        writeScratch(path, maker.container());
        return collect(*openMeshSources({path}, mebibytes(64), {}, textures));
    }

    std::string refusalOf(const std::string& text, Bytes limit = mebibytes(64)) {
        writeScratch(path, text);
        return errorAbout(path, [&] { collect(*openMeshSources({path}, limit)); });
    }

    const std::string path = testing::TempDir() + "gnomon_gltf_" +
                             testing::UnitTest::GetInstance()->current_test_info()->name() +
                             std::to_string(::getpid()) + ".glb";
};

TEST_F(ReadMadeGltf, MirroredPlacementsKeepTheirOutside) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors(kTriangle);
    maker.attributes()["NORMAL"] = maker.addVectors({0, 0, 1, 0, 0, 1, 0, 0, 1});
    Random random(7);
    for (int round = 0; round < 200; ++round) {
        json scale = json::array();
        json turn = json::array();
        double length = 0;
        for (int i = 0; i < 3; ++i)
            scale.push_back((random.below(2) == 0 ? -1 : 1) * random.uniform(0.1, 4));
        for (int i = 0; i < 4; ++i) {
            turn.push_back(random.uniform(-1, 1));
            length += std::pow(turn[static_cast<std::size_t>(i)].get<double>(), 2);
        }
        for (json& part : turn)
            part = part.get<double>() / std::sqrt(length);
        maker.document["nodes"][0] = {{"mesh", 0}, {"scale", scale}, {"rotation", turn}, {"translation", {1, 2, 3}}};
        const CollectedMesh mesh = meshOf(maker);
        const auto& [a, b, c] = mesh.triangles.at(0);
        const glm::dvec3 outside =
            glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
        EXPECT_GT(glm::dot(outside, glm::dvec3(mesh.normals[0])), 0.999 * glm::length(outside)) << scale << turn;
    }
}

TEST_F(ReadMadeGltf, BaseColoursAreFactorsTimesThoseOfVertices) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors(kTriangle);
    maker.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0, 0.5}}}}}};
    maker.primitive()["material"] = 0;
    // Half of the light is level 188 of sRGB; alpha does not count where a material does not ask for it.
    EXPECT_EQ(meshOf(maker).colors, (std::vector<std::uint32_t>(3, 0xFF00BCFF)));
    maker.attributes()["COLOR_0"] = maker.addVectors({1, 1, 1, 0.5, 0.5, 0.5, 0, 0, 0});
    maker.document["materials"][0]["alphaMode"] = "BLEND";
    EXPECT_EQ(meshOf(maker).colors, (std::vector<std::uint32_t>{0x8000BCFF, 0x800089BC, 0x80000000}));
}

// Two texels, red and blue, as a PNG.
constexpr const char* kRedAndBlue = "data:image/png;base64,"
                                    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAADUlEQVR42mP4zwAE/wEHAAH/"
                                    "PX2MSQAAAABJRU5ErkJggg==";

TEST_F(ReadMadeGltf, TexturesAreLookedUpAtVertices) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors(kTriangle);
    maker.attributes()["TEXCOORD_0"] = maker.addVectors({0.25, 0.5, 0.75, 0.5, 2.5, 0.5}, 2);
    maker.document["images"] = {{{"uri", kRedAndBlue}}};
    maker.document["textures"] = {{{"source", 0}}};
    maker.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    maker.primitive()["material"] = 0;
    // In the middle of the texels, and half way between them: half of the light of each.
    EXPECT_EQ(meshOf(maker).colors, (std::vector<std::uint32_t>{0xFF0000FF, 0xFFFF0000, 0xFFBC00BC}));
    EXPECT_TRUE(meshOf(maker, Textures::Off).colors.empty());
    EXPECT_GT(*openMeshSources({path}, mebibytes(64))->summary().texelsPerEdge, 0.9);
    maker.document["images"] = {{{"uri", "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAA"}}};
    EXPECT_NE(refusalOf(maker.container()).find("image 0: the PNG is damaged"), std::string::npos);
    maker.document["images"] = {{{"uri", "nothing_here.png"}}};
    EXPECT_TRUE(meshOf(maker).colors.empty());
}

TEST_F(ReadMadeGltf, ClaimsThatTheBytesDoNotHoldAreRefused) {
    const auto refusal = [&](const std::function<void(GltfMaker&)>& spoil, Bytes limit = mebibytes(64)) {
        GltfMaker maker;
        maker.attributes()["POSITION"] = maker.addVectors(kTriangle);
        maker.primitive()["indices"] = maker.add(std::vector<std::uint16_t>{0, 1, 2}, "SCALAR", 5123, 1);
        spoil(maker);
        return refusalOf(maker.container(), limit);
    };
    const auto holds = [](const std::string& message, const char* words) {
        EXPECT_NE(message.find(words), std::string::npos) << message;
    };
    holds(refusal([](GltfMaker& m) { m.document["accessors"][0]["count"] = 4; }), "accessor 0: the range is outside");
    holds(refusal([](GltfMaker& m) { m.document["accessors"][0]["count"] = kMany; }), "a need for");
    holds(
        refusal([](GltfMaker& m) { m.document["accessors"][0]["byteOffset"] = 8; }),
        "accessor 0: the range is outside");
    holds(
        refusal([](GltfMaker& m) { m.document["bufferViews"][0]["byteLength"] = kMany; }),
        "buffer view 0: the range is outside");
    holds(
        refusal([](GltfMaker& m) { m.document["bufferViews"][0]["byteOffset"] = kMany; }),
        "buffer view 0: the range is outside");
    holds(refusal([](GltfMaker& m) { m.document["bufferViews"][0]["buffer"] = 7; }), "no such buffer");
    holds(refusal([](GltfMaker& m) { m.document["accessors"][1]["componentType"] = 5126; }), "not unsigned integers");
    holds(
        refusal([](GltfMaker& m) { m.document["accessors"][0]["type"] = "VEC2"; }),
        "accessor 0: wrong number of components");
    holds(refusal([](GltfMaker& m) { m.document["nodes"][0]["mesh"] = 3; }), "no such mesh");
    holds(refusal([](GltfMaker& m) { m.primitive()["material"] = 1; }), "no such material");
    holds(refusal([](GltfMaker& m) { m.document["scene"] = 4; }), "no such scene");
    holds(refusal([](GltfMaker& m) { m.document["nodes"][0]["children"] = {0}; }), "node 0: the nodes are not a tree");
    holds(
        refusal([](GltfMaker& m) { m.document["extensionsRequired"] = {"A_B"}; }),
        "requires an unsupported glTF extension");
    const auto sparse = [](GltfMaker& m) {
        m.document["accessors"][0] = {
            {"componentType", 5126},
            {"count", kMany},
            {"type", "VEC3"},
            {"sparse",
             {{"count", 1},
              {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
              {"values", {{"bufferView", 0}}}}}};
    };
    holds(refusal(sparse), "a need for");
    const auto packed = [](GltfMaker& m) {
        m.document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
            {"buffer", 0}, {"byteLength", 36}, {"byteStride", 12}, {"mode", "ATTRIBUTES"}, {"count", 2'000'000'000}};
    };
    holds(refusal(packed), "a need for");
}

TEST_F(ReadMadeGltf, ADeepDocumentIsRefused) {
    const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
    const std::string plain = path.substr(0, path.size() - 4) + ".gltf";
    writeScratch(plain, R"({"asset":{"version":"2.0"},"extras":)" + deep + "}");
    EXPECT_NE(
        errorAbout(plain, [&] { collect(*openMeshSources({plain}, mebibytes(64))); }).find("nested too deep"),
        std::string::npos);
    std::filesystem::remove(plain);
}

/// The triangles of a list of corners in one of glTF's modes, by its words.
std::vector<TriangleCorners> plainTriangles(int mode, const std::vector<std::uint32_t>& corners) {
    std::vector<TriangleCorners> triangles;
    if (mode == 4)
        for (std::size_t i = 0; i < corners.size(); i += 3)
            triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    if (mode == 5)
        for (std::size_t i = 0; i + 2 < corners.size(); ++i)
            triangles.push_back(
                i % 2 == 0 ? TriangleCorners{corners[i], corners[i + 1], corners[i + 2]}
                           : TriangleCorners{corners[i], corners[i + 2], corners[i + 1]});
    if (mode == 6)
        for (std::size_t i = 1; i + 1 < corners.size(); ++i)
            triangles.push_back({corners[i], corners[i + 1], corners[0]});
    return triangles;
}

TEST_F(ReadMadeGltf, StripsFansAndTypesOfIndicesAgreeWithTheirTriangles) {
    Random random(11);
    for (int round = 0; round < 100; ++round) {
        const std::size_t count = 3 + random.below(20);
        std::vector<std::uint32_t> corners(count);
        for (std::uint32_t& corner : corners)
            corner = static_cast<std::uint32_t>(random.below(50));
        std::vector<float> positions(150);
        for (float& value : positions)
            value = static_cast<float>(random.uniform(-1, 1));
        const int mode = 4 + static_cast<int>(random.below(3));
        if (mode == 4) corners.resize(count / 3 * 3);
        GltfMaker maker;
        maker.attributes()["POSITION"] = maker.addVectors(positions);
        maker.primitive()["mode"] = mode;
        const std::vector<std::uint8_t> bytes(corners.begin(), corners.end());
        const std::vector<std::uint16_t> words(corners.begin(), corners.end());
        const std::uint64_t width = random.below(3);
        maker.primitive()["indices"] = width == 0   ? maker.add(bytes, "SCALAR", 5121, 1)
                                       : width == 1 ? maker.add(words, "SCALAR", 5123, 1)
                                                    : maker.add(corners, "SCALAR", 5125, 1);
        const CollectedMesh mesh = meshOf(maker);
        EXPECT_EQ(mesh.triangles, plainTriangles(mode, corners)) << mode;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            EXPECT_EQ(mesh.positions[i], glm::dvec3(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]));
    }
}

/// Bytes changed, cut off and swapped: a mesh or one line, whatever comes.
void mangle(const std::string& original, const std::string& path, std::uint64_t seed, int rounds) {
    Random random(seed);
    int refused = 0;
    for (int round = 0; round < rounds; ++round) {
        std::string text = original;
        const std::uint64_t changes = 1 + random.below(4);
        for (std::uint64_t i = 0; i < changes; ++i) {
            const std::size_t at = random.below(text.size());
            const std::uint64_t kind = random.below(4);
            if (kind == 0) text[at] = static_cast<char>(random.below(256));
            if (kind == 1) text[at] = static_cast<char>('0' + random.below(10));
            if (kind == 2) text[at] = static_cast<char>(text[at] ^ static_cast<char>(1U << random.below(8)));
            if (kind == 3 && random.below(8) == 0) text.resize(at + 1);
        }
        writeScratch(path, text);
        refused += errorAbout(path, [&] { collect(*openMeshSources({path}, mebibytes(64))); }) != "no error" ? 1 : 0;
    }
    EXPECT_GT(refused, rounds / 10);
}

TEST_F(ReadMadeGltf, MangledFilesGiveAMeshOrOneLine) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors(kTriangle);
    maker.attributes()["NORMAL"] = maker.addVectors({0, 0, 1, 0, 0, 1, 0, 0, 1});
    maker.attributes()["TEXCOORD_0"] = maker.addVectors({0.25, 0.5, 0.75, 0.5, 0.5, 0.5}, 2);
    maker.attributes()["COLOR_0"] = maker.addVectors({1, 1, 1, 1, 0, 0, 0, 1, 1}, 3);
    maker.primitive()["indices"] = maker.add(std::vector<std::uint16_t>{0, 1, 2}, "SCALAR", 5123, 1);
    maker.document["images"] = {{{"uri", kRedAndBlue}}};
    maker.document["textures"] = {{{"source", 0}}};
    maker.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    maker.primitive()["material"] = 0;
    maker.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        maker.attributes()["POSITION"];
    ASSERT_EQ(meshOf(maker).triangles.size(), 3U);
    mangle(maker.container(), path, 1, 1500);
}

TEST_F(ReadMadeGltf, MangledRealFilesGiveAMeshOrOneLine) {
    SKIP_WITHOUT_FORMATS();
    for (const char* const name : {"pirate.glb", "BoxVertexColors.glb", "BoxInterleaved.glb", "cakeBirthday.glb"}) {
        std::ifstream file(formatsFolder() + "/gltf/" + name, std::ios::binary);
        const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        ASSERT_FALSE(text.empty());
        mangle(text, path, 2, 100);
    }
}

} // namespace
} // namespace gnomon::read
