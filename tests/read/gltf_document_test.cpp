// glTF documents: containers with other chunks, uris, required extensions, and the names of data that no model uses.
#include "core/limit_error.h"
#include "core/units.h"
#include "preprocess/read/gltf/uri.h"
#include "preprocess/read/open_mesh_sources.h"
#include "tests/read/collect.h"
#include "tests/support/gltf_maker.h"

#include <gtest/gtest.h>

#include <limits>

#include <unistd.h>

namespace gnomon::read {
namespace {

using nlohmann::json;
using NamedCounts = std::map<std::string, std::uint64_t>;

const std::vector<float> kOneTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};

// A red and a blue pixel, as a PNG.
constexpr const char* kTwoPixels = "data:image/png;base64,"
                                   "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAADUlEQVR42mP4zwAE/wEHAAH/"
                                   "PX2MSQAAAABJRU5ErkJggg==";

class GltfDocument : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder); }

    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string refusalOf(const std::string& text, Textures textures = Textures::Bake) {
        writeScratch(path, text);
        return errorAbout(path, [&] { collect(*openMeshSources({path}, mebibytes(64), {}, textures)); });
    }

    MeshSummary summaryOf(GltfMaker& maker, Textures textures = Textures::Bake) {
        writeScratch(path, maker.container());
        return openMeshSources({path}, mebibytes(64), {}, textures)->summary();
    }

    const std::string folder = testing::TempDir() + "gnomon_gltf_document_" +
                               testing::UnitTest::GetInstance()->current_test_info()->name() +
                               std::to_string(::getpid());
    const std::string path = folder + "/a.glb";
};

void expectHolds(const std::string& message, const std::string& words) {
    EXPECT_NE(message.find(words), std::string::npos) << message << "\nlacks: " << words;
}

std::string littleEndian(std::uint64_t value) {
    std::string raw(4, '\0');
    for (std::size_t i = 0; i < 4; ++i)
        raw[i] = static_cast<char>(value >> 8 * i & 0xFFU);
    return raw;
}

std::string chunkOf(const std::string& type, const std::string& content) {
    return littleEndian(content.size()) + type + content;
}

std::string containerOf(const std::vector<std::string>& chunks) {
    std::string body;
    for (const std::string& chunk : chunks)
        body += chunk;
    return "glTF" + littleEndian(2) + littleEndian(12 + body.size()) + body;
}

TEST_F(GltfDocument, ChunksOfOtherTypesAreSkippedAndCounted) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors(kOneTriangle);
    maker.container();
    std::string text = maker.document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string binary(reinterpret_cast<const char*>(kOneTriangle.data()), 36);
    const std::string document = chunkOf("JSON", text);
    const std::string buffer = chunkOf(std::string("BIN\0", 4), binary);
    const std::string other = chunkOf("XTRA", "12345678");
    const std::string none = chunkOf("NONE", "");
    const std::vector<std::pair<std::vector<std::string>, std::uint64_t>> containers = {
        {{document, buffer}, 0},
        {{document, other, buffer}, 1},
        {{document, other, none, buffer}, 2},
        {{document, buffer, other}, 1},
        {{document, none, buffer, other, other}, 3},
        {{document, buffer, chunkOf(std::string("BIN\0", 4), "other buffer")}, 1}};
    for (const auto& [chunks, skipped] : containers) {
        writeScratch(path, containerOf(chunks));
        const auto source = openMeshSources({path}, mebibytes(64));
        EXPECT_EQ(collect(*source).positions.at(1), glm::dvec3(1, 0, 0));
        EXPECT_EQ(
            source->summary().attributesDropped,
            skipped == 0 ? NamedCounts() : (NamedCounts{{"chunks of other types", skipped}}));
    }
    const auto withLength = [](std::string chunk, std::uint64_t length) {
        return chunk.replace(0, 4, littleEndian(length));
    };
    expectHolds(
        refusalOf(containerOf({document, withLength(other, 1U << 30U), buffer})),
        "byte " + std::to_string(12 + document.size()) +
            ": a chunk of the .glb ends after the file: expected at most 52 bytes, found 1073741824");
    expectHolds(refusalOf(containerOf({document, withLength(other, 7), buffer})), "a chunk of the .glb ends after");
    expectHolds(refusalOf(containerOf({document, withLength(buffer, 37)})), "expected at most 36 bytes, found 37");
    expectHolds(refusalOf(containerOf({document, buffer, withLength(other, ~0U)})), "found 4294967295");
    expectHolds(refusalOf(containerOf({other, document, buffer})), "not a .glb: expected a first chunk of JSON");
    std::string cut = containerOf({document, other, buffer});
    expectHolds(refusalOf(cut.substr(0, cut.size() - 44)), "the file ends too early");
    expectHolds(refusalOf(cut.replace(8, 4, littleEndian(3))), "the .glb has a wrong length: expected 20 to");
}

TEST_F(GltfDocument, UrisNameFilesByTheirBytes) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors(kOneTriangle);
    maker.container();
    const std::string raw(reinterpret_cast<const char*>(kOneTriangle.data()), 36);
    const std::string plain = folder + "/c.gltf";
    const auto messageFor = [&](const std::string& uri) {
        maker.document["buffers"][0]["uri"] = uri;
        writeScratch(plain, maker.document.dump());
        return errorAbout(plain, [&] { collect(*openMeshSources({plain}, mebibytes(64))); });
    };
    std::filesystem::create_directories(folder + "/sub");
    const std::vector<std::pair<std::string, std::string>> good = {
        {"a b.bin", "a%20b.bin"},
        {"a b.bin", "a b.bin"},
        {"\xC3\xBC.bin", "%C3%bC.bin"},
        {"\xC3\xBC.bin", "\xC3\xBC.bin"},
        {"sub/a.bin", "sub%2Fa.bin"},
        {"a%00.bin", "a%2500.bin"},
        {"100%.bin", "100%25.bin"},
        {"100%.bin", "100%.bin"},
        {"%zz.bin", "%zz.bin"}};
    for (const auto& [name, uri] : good) {
        writeScratch((std::filesystem::path(folder) / name).string(), raw);
        EXPECT_EQ(messageFor(uri), "no error") << uri;
        std::filesystem::remove(std::filesystem::path(folder) / name);
    }
    for (const char* const uri : {"%00.bin", "a%00.bin", "a.bin%00", "sub/%00"})
        expectHolds(messageFor(uri), "buffer 0: the uri contains a zero byte (%00): expected");
    expectHolds(messageFor(std::string("a\0.bin", 6)), "a zero byte (%00)");
    for (const char* const uri : {"a%2.bin", "a%", "%zz.bin"})
        expectHolds(messageFor(uri), "a percent sign without two hexadecimal digits: expected %25");
    maker.document["buffers"][0].erase("uri");
    maker.document["images"] = {{{"uri", "a%00.png"}}};
    maker.document["textures"] = {{{"source", 0}}};
    maker.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    maker.attributes()["TEXCOORD_0"] = maker.addVectors({0, 0, 1, 0, 0, 1}, 2);
    maker.primitive()["material"] = 0;
    expectHolds(refusalOf(maker.container()), "image 0: the uri contains a zero byte (%00)");
}

TEST(DataUri, HasTheBytesOfItsBase64) {
    const auto textOfUri = [](const std::string& uri) {
        const std::vector<std::byte> bytes = bytesOfDataUri(uri, "x");
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    EXPECT_EQ(textOfUri("data:application/octet-stream;base64,"), "");
    EXPECT_EQ(textOfUri("data:application/gltf-buffer;base64,TQ=="), "M"); // RFC 4648
    EXPECT_EQ(textOfUri("data:;base64,TWE="), "Ma");
    EXPECT_EQ(textOfUri("data:model/any;charset=utf-8;base64,TWFu"), "Man");
    EXPECT_EQ(textOfUri("data:;base64,TWFuTWE"), "ManMa");
    EXPECT_EQ(textOfUri("data:;base64,+/+/"), "\xFB\xFF\xBF");
    for (const char* const uri : {"data:;base64,T*==", "data:;base64,TW=u", "data:;base64,TW u"})
        expectHolds(errorAbout("x", [&] { bytesOfDataUri(uri, "x"); }), ": the base64 data is damaged");
    for (const char* const uri : {"data:text/plain,TWFu", "data:", "data:;base64"})
        expectHolds(errorAbout("x", [&] { bytesOfDataUri(uri, "x"); }), ": cannot be understood");
}

TEST_F(GltfDocument, RequiredFormatsOfTexturesMatterOnlyWhereTexturesAreRead) {
    for (const char* const name : {"KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif", "MSFT_texture_dds"}) {
        GltfMaker maker;
        maker.attributes()["POSITION"] = maker.addVectors(kOneTriangle);
        maker.document["extensionsUsed"] = {name};
        maker.document["extensionsRequired"] = {name};
        maker.document["images"] = {{{"uri", "not_there.any"}}};
        maker.document["textures"] = {{{"extensions", {{name, {{"source", 0}}}}}}};
        maker.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
        maker.primitive()["material"] = 0;
        expectHolds(
            refusalOf(maker.container()),
            "requires an unsupported texture format: expected PNG or JPEG, found " + std::string(name));
        EXPECT_THROW(summaryOf(maker), LimitError) << "the command names its option";
        EXPECT_EQ(summaryOf(maker, Textures::Off).attributesDropped, (NamedCounts{{name, 1}, {"textures", 1}}));
        maker.document["extensionsRequired"].push_back("A_B");
        expectHolds(refusalOf(maker.container(), Textures::Off), "requires an unsupported glTF extension: \"A_B\"");
        maker.document.erase("extensionsRequired");
        EXPECT_EQ(refusalOf(maker.container()), "no error") << "it is not required";
    }
}

/// A mesh with data of every kind that a model does not use.
GltfMaker makerOfUnusedData() {
    GltfMaker maker;
    const std::vector<float> four = {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1};
    maker.attributes()["POSITION"] = maker.addVectors(kOneTriangle);
    maker.attributes()["TEXCOORD_0"] = maker.addVectors({0.25, 0.5, 0.75, 0.5, 0.5, 0.5}, 2);
    maker.attributes()["TEXCOORD_1"] = maker.attributes()["TEXCOORD_0"];
    maker.attributes()["COLOR_1"] = maker.addVectors(four, 4);
    maker.attributes()["TANGENT"] = maker.attributes()["COLOR_1"];
    maker.attributes()["WEIGHTS_0"] = maker.attributes()["COLOR_1"];
    maker.attributes()["JOINTS_0"] = maker.add(std::vector<std::uint8_t>(12, 0), "VEC4", 5121, 4);
    maker.attributes()["_CUSTOM"] = maker.addVectors(kOneTriangle);
    maker.primitive()["material"] = 0;
    maker.primitive()["targets"] = {{{"POSITION", 0}}};
    maker.primitive()["extras"] = {{"extensions", {{"inside_extras", 1}}}};
    json& primitives = maker.document["meshes"][0]["primitives"];
    for (const int mode : {0, 1, 2, 3})
        primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", mode}});
    primitives.push_back({{"attributes", {{"POSITION", 0}, {"NORMAL", 0}}}});
    primitives.push_back({{"attributes", {{"NORMAL", 0}}}});
    maker.document["images"] = {{{"uri", kTwoPixels}}};
    maker.document["textures"] = {{{"source", 0}}};
    maker.document["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorTexture", {{"index", 0}}},
           {"metallicFactor", 0},
           {"roughnessFactor", 1},
           {"metallicRoughnessTexture", {{"index", 0}}}}},
         {"normalTexture", {{"index", 0}}},
         {"occlusionTexture", {{"index", 0}}},
         {"emissiveTexture", {{"index", 0}}},
         {"emissiveFactor", {1, 1, 1}},
         {"alphaMode", "BLEND"},
         {"doubleSided", true},
         {"extensions", {{"KHR_materials_ior", {{"ior", 1.4}}}}}},
        {{"extensions",
          {{"KHR_materials_pbrSpecularGlossiness",
            {{"diffuseFactor", {1, 0, 0, 1}}, {"specularFactor", {1, 1, 1}}, {"glossinessFactor", 0.5}}}}}}};
    maker.document["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.0}, {"znear", 0.1}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 9}, {"znear", 0}}}},
        {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
    maker.document["nodes"] = {
        {{"mesh", 0}, {"children", {1, 2, 3}}, {"skin", 0}},
        {{"camera", 0}, {"rotation", {0, 0, 0, 0}}},
        {{"camera", 1}},
        {{"camera", 2}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
        {{"mesh", 0}}};
    maker.document["animations"] = {{{"channels", json::array()}, {"samplers", json::array()}}};
    maker.document["skins"] = {{{"joints", {1}}}};
    maker.document["extensions"] = {
        {"KHR_lights_punctual", {{"lights", {{{"type", "point"}}, {{"type", "spot"}}}}}}, {"MY_root", json::object()}};
    maker.document["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_ior", "MY_root", "MY_announced"};
    maker.document["asset"]["extras"] = {{"author", "nobody"}};
    return maker;
}

TEST_F(GltfDocument, AllDataThatNoModelUsesIsNamedAndCounted) {
    GltfMaker maker = makerOfUnusedData();
    NamedCounts expected = {
        {"COLOR_1", 1},
        {"JOINTS_0", 1},
        {"KHR_materials_ior", 1},
        {"MY_announced", 1},
        {"MY_root", 1},
        {"NORMAL", 1},
        {"TANGENT", 1},
        {"TEXCOORD_1", 1},
        {"WEIGHTS_0", 1},
        {"_CUSTOM", 1},
        {"alpha", 3},
        {"animations", 1},
        {"cameras", 1},
        {"emissiveFactor", 1},
        {"emissiveTexture", 1},
        {"extras", 1},
        {"glossinessFactor", 1},
        {"lights", 2},
        {"metallicFactor", 1},
        {"metallicRoughnessTexture", 1},
        {"morph targets", 1},
        {"nodes of other scenes", 1},
        {"normalTexture", 1},
        {"occlusionTexture", 1},
        {"orthographic cameras", 1},
        {"primitives of lines", 3},
        {"primitives of points", 1},
        {"primitives without positions", 1},
        {"rotations of length 0", 1},
        {"roughnessFactor", 1},
        {"skins", 1},
        {"specularFactor", 1}};
    const MeshSummary summary = summaryOf(maker);
    EXPECT_EQ(summary.attributesDropped, expected);
    EXPECT_EQ(summary.faceCount, 2U);
    EXPECT_EQ(summary.cameras.size(), 1U);
    expected["TEXCOORD_0"] = 1;
    expected["textures"] = 1;
    expected.erase("alpha"); // the texture's
    EXPECT_EQ(summaryOf(maker, Textures::Off).attributesDropped, expected);
}

TEST_F(GltfDocument, AlphasOfVerticesAreCountedUnlessOpaque) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors(kOneTriangle);
    maker.attributes()["COLOR_0"] = maker.addVectors({1, 0, 0, 0.5, 1, 0, 0, 1, 1, 0, 0, 0}, 4);
    EXPECT_EQ(summaryOf(maker).attributesDropped, (NamedCounts{{"alpha", 2}}));
    maker.attributes()["COLOR_0"] =
        maker.add(std::vector<std::uint8_t>{9, 0, 0, 255, 9, 0, 0, 254, 9, 0, 0, 255}, "VEC4", 5121, 4);
    maker.document["accessors"].back()["normalized"] = true;
    EXPECT_EQ(summaryOf(maker).attributesDropped, (NamedCounts{{"alpha", 1}}));
}

TEST_F(GltfDocument, AFileWithoutUnusedDataNamesNone) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors(kOneTriangle);
    maker.attributes()["NORMAL"] = maker.addVectors({0, 0, 1, 0, 0, 1, 0, 0, 1});
    maker.attributes()["COLOR_0"] = maker.addVectors(kOneTriangle);
    maker.attributes()["TEXCOORD_0"] = maker.addVectors({0.25, 0.5, 0.75, 0.5, 0.5, 0.5}, 2);
    maker.document["asset"]["extras"] = {{"author", "nobody"}};
    maker.document["images"] = {{{"uri", kTwoPixels}}};
    maker.document["textures"] = {{{"source", 0}}};
    maker.document["samplers"] = {{{"wrapS", 10497}}};
    maker.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    maker.primitive()["material"] = 0;
    EXPECT_EQ(summaryOf(maker).attributesDropped, NamedCounts());
    const float none = std::numeric_limits<float>::quiet_NaN();
    maker.attributes()["NORMAL"] =
        maker.addVectors({0, 0, 1, 0, none, 1, std::numeric_limits<float>::infinity(), 0, 1});
    EXPECT_EQ(summaryOf(maker).attributesDropped, (NamedCounts{{"normals that are not finite", 2}}));
    const CollectedMesh mesh = collect(*openMeshSources({path}, mebibytes(64)));
    EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 0}, {0, 0, 0}}));
}

} // namespace
} // namespace gnomon::read
