// What a file of glTF holds and refers to: containers, buffers in and beside it, packed views; and scenes as sources.
#include "core/random.h"
#include "preprocess/read/gltf/gltf_accessor.h"
#include "preprocess/read/gltf/gltf_file.h"
#include "preprocess/read/open_mesh_sources.h"
#include "tests/read/collect.h"
#include "tests/support/gltf_maker.h"

#include <gtest/gtest.h>

#include <cmath>

#include <meshoptimizer.h>
#include <unistd.h>

namespace gnomon::read {
namespace {

using nlohmann::json;

const std::vector<float> kCorners = {0, 0, 0, 1, 0, 0, 0, 1, 0};

class GltfContainer : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder); }

    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string refusalOf(const std::string& text) {
        writeScratch(path, text);
        return errorAbout(path, [&] { collect(*openMeshSources({path}, mebibytes(64))); });
    }

    void expectRefusal(const std::string& text, const std::string& words) {
        const std::string message = refusalOf(text);
        EXPECT_NE(message.find(words), std::string::npos) << message;
    }

    const std::string folder = testing::TempDir() + "gnomon_gltf_file_" +
                               testing::UnitTest::GetInstance()->current_test_info()->name() +
                               std::to_string(::getpid());
    const std::string path = folder + "/a.glb";
};

std::string withWord(std::string text, std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i)
        text[at + i] = static_cast<char>(value >> 8 * i & 0xFFU);
    return text;
}

TEST_F(GltfContainer, IsReadAsFarAsItIsThere) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors(kCorners);
    const std::string good = maker.container();
    EXPECT_EQ(refusalOf(good), "no error");
    for (std::size_t length = 1; length < good.size(); length += 7)
        EXPECT_NE(refusalOf(good.substr(0, length)), "no error") << length;
    expectRefusal(withWord(good, 4, 1), "not glTF 2.0: expected version 2, found 1");
    expectRefusal(withWord(good, 12, 1U << 30U), "a chunk of the .glb ends after the file");
    expectRefusal(withWord(good, 12, ~0U), "a chunk of the .glb ends after the file");
    expectRefusal(withWord(good, 16, 0), "not a .glb");
    const std::size_t binary = good.size() - 36 - 8;
    expectRefusal(withWord(good, binary, ~0U), "a chunk of the .glb ends after the file");
    expectRefusal(withWord(good, binary + 4, 0), "buffer view 0: the range is outside its buffer");
    EXPECT_EQ(refusalOf(good + "what a later version appends"), "no error");
}

TEST_F(GltfContainer, FilesOutsideOfTheSourceRootAreRefused) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors(kCorners);
    maker.container();
    const std::string raw(reinterpret_cast<const char*>(kCorners.data()), kCorners.size() * sizeof(float));
    writeScratch(folder + "/b.bin", raw);
    std::filesystem::create_directories(folder + "/deep/er");
    const std::string plain = folder + "/deep/c.gltf";
    const auto messageOf = [&](const std::string& uri, const std::string& root) {
        maker.document["buffers"][0]["uri"] = uri;
        writeScratch(plain, maker.document.dump());
        return errorAbout(plain, [&] { collect(*openMeshSources({plain}, mebibytes(64), {}, Textures::Bake, root)); });
    };
    const std::string refused =
        ": buffer 0: refers to a file outside the folder of the source: expected a path below " + folder +
        "/deep, found ";
    for (const char* const uri :
         {"../b.bin", "%2e%2e/b.bin", "..%2Fb.bin", "er/../../b.bin", "./../b.bin", "/etc/passwd", "../gone.bin"})
        EXPECT_TRUE(messageOf(uri, "").starts_with(refused)) << messageOf(uri, "");
    EXPECT_EQ(messageOf("../b.bin", folder), "no error");
    EXPECT_EQ(messageOf(folder + "/b.bin", folder), "no error") << "an absolute path inside the root";
    EXPECT_EQ(messageOf("er/../../b.bin", folder + "/"), "no error");
    EXPECT_EQ(messageOf("../b.bin", "/"), "no error");
    EXPECT_NE(messageOf("../b.bin", folder + "/deep/er").find("outside the folder"), std::string::npos);
    EXPECT_NE(messageOf("../../b.bin", folder).find("outside the folder"), std::string::npos);
    EXPECT_NE(messageOf("a%00b", "").find("%00"), std::string::npos);
    std::filesystem::create_symlink(folder, folder + "/link");
    EXPECT_EQ(messageOf("../b.bin", folder + "/link"), "no error") << "another name of the same folder";
    std::filesystem::create_symlink("../b.bin", folder + "/deep/b.bin");
    std::filesystem::create_symlink("..", folder + "/deep/up");
    std::filesystem::create_symlink("er", folder + "/deep/inside");
    std::filesystem::copy_file(folder + "/b.bin", folder + "/deep/er/b.bin");
    for (const char* const uri : {"b.bin", "up/b.bin", "inside/../../b.bin"})
        EXPECT_TRUE(messageOf(uri, "").starts_with(refused)) << messageOf(uri, "");
    EXPECT_EQ(messageOf("b.bin", folder), "no error");
    EXPECT_EQ(messageOf("inside/b.bin", ""), "no error") << "a link to a place inside";
}

TEST_F(GltfContainer, BuffersMayLieBesideItAndInIt) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors(kCorners);
    maker.container();
    const std::string raw(reinterpret_cast<const char*>(kCorners.data()), kCorners.size() * sizeof(float));
    writeScratch(folder + "/b \xE2\x9D\xA4.bin", raw);
    const auto withUri = [&](const std::string& uri) {
        maker.document["buffers"][0]["uri"] = uri;
        return maker.document.dump();
    };
    const std::string plain = folder + "/c.gltf";
    const auto messageOf = [&](const std::string& text) {
        writeScratch(plain, text);
        return errorAbout(plain, [&] { collect(*openMeshSources({plain}, mebibytes(64))); });
    };
    EXPECT_EQ(messageOf(withUri("b%20\xE2\x9D\xA4.bin")), "no error");
    EXPECT_EQ(
        openMeshSources({plain}, mebibytes(64))->summary().additionalFiles,
        std::vector<std::string>{folder + "/b \xE2\x9D\xA4.bin"});
    EXPECT_EQ(
        messageOf(withUri("data:application/octet-stream;base64,"
                          "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA")),
        "no error");
    const auto holds = [](const std::string& message, const char* words) {
        EXPECT_NE(message.find(words), std::string::npos) << message;
    };
    holds(messageOf(withUri("data:application/octet-stream;base64,AAAA")), "buffer 0: too short: expected 36 bytes");
    holds(messageOf(withUri("data:text/html,hello")), "buffer 0: cannot be understood");
    holds(messageOf(withUri("/b.bin")), "refers to a file outside the folder of the source");
    holds(messageOf(withUri("https://example.org/b.bin")), "the uri is not a plain path");
    maker.document["buffers"][0].erase("byteLength");
    holds(
        messageOf(withUri("b%20\xE2\x9D\xA4.bin")),
        "buffer 0: its byteLength is missing or not a whole number: expected a number of bytes");
    maker.document["buffers"][0]["byteLength"] = 36;
    writeScratch(plain, withUri("missing.bin"));
    const std::string missing = folder + "/missing.bin";
    holds(errorAbout(missing, [&] { openMeshSources({plain}, mebibytes(64)); }), "No such file");
    holds(messageOf("[]"), "not glTF");
    holds(messageOf("{"), "not glTF");
    for (const char* const version : {"1.0", "3.0", "20.0", "", "two"})
        holds(
            messageOf(R"({"asset":{"version":")" + std::string(version) + R"("}})"),
            R"(not glTF 2.0: expected "2.0" as the version of the asset, found ")");
    holds(messageOf(R"({"asset":{}})"), "not glTF 2.0: expected \"2.0\" as the version");
    holds(messageOf("{}"), "not glTF 2.0: expected \"2.0\" as the version");
    holds(
        messageOf(R"({"asset":{"version":"2.1","minVersion":"2.1"}})"),
        ": requires a newer version of glTF: expected a minVersion of at most 2.0, found \"2.1\"");
    holds(messageOf(R"({"asset":{"version":"2.1","minVersion":"2.0"}})"), "no triangles");
    holds(messageOf(R"({"asset":{"version":"2.9"}})"), "no triangles");
    holds(messageOf(R"({"asset":{"version":"2.0"}})"), "no triangles");
    holds(messageOf(R"({"asset":{"version":"2.0"},"buffers":3})"), "expected \"buffers\" as an array");
}

/// A view that EXT_meshopt_compression packs, of `count` elements of `stride` bytes, in place of the maker's view
/// `view`.
void packView(GltfMaker& maker, std::size_t view, const std::vector<unsigned char>& packed, json how) {
    maker.add(packed, "SCALAR", 5121, 1);
    const json& held = maker.document["bufferViews"].back();
    how["buffer"] = 0;
    how["byteOffset"] = held["byteOffset"];
    how["byteLength"] = held["byteLength"];
    maker.document["bufferViews"][view]["extensions"]["EXT_meshopt_compression"] = how;
    maker.document["bufferViews"][view]["buffer"] = 1; // which has no bytes
}

TEST_F(GltfContainer, PackedViewsAreWhatWasPacked) {
    Random random(21);
    for (int round = 0; round < 40; ++round) {
        const std::size_t vertices = 3 + random.below(300);
        std::vector<float> positions(3 * vertices);
        for (float& value : positions)
            value = static_cast<float>(random.uniform(-1, 1));
        std::vector<std::uint32_t> corners(3 * (1 + random.below(400)));
        for (std::uint32_t& corner : corners)
            corner = static_cast<std::uint32_t>(random.below(vertices));
        GltfMaker maker;
        maker.attributes()["POSITION"] = maker.addVectors(positions);
        maker.primitive()["indices"] = maker.add(corners, "SCALAR", 5125, 1);
        std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(vertices, 12));
        packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), positions.data(), vertices, 12));
        packView(maker, 0, packed, {{"mode", "ATTRIBUTES"}, {"count", vertices}, {"byteStride", 12}});
        const bool isSequence = random.below(2) == 0;
        packed.resize(
            isSequence ? meshopt_encodeIndexSequenceBound(corners.size(), vertices)
                       : meshopt_encodeIndexBufferBound(corners.size(), vertices));
        packed.resize(
            isSequence ? meshopt_encodeIndexSequence(packed.data(), packed.size(), corners.data(), corners.size())
                       : meshopt_encodeIndexBuffer(packed.data(), packed.size(), corners.data(), corners.size()));
        packView(
            maker,
            1,
            packed,
            {{"mode", isSequence ? "INDICES" : "TRIANGLES"}, {"count", corners.size()}, {"byteStride", 4}});
        maker.container();
        json buffers = maker.document["buffers"];
        buffers.push_back({{"byteLength", 1 << 20}}); // the fallback that is not there
        writeScratch(path, maker.containerWith(buffers));
        const CollectedMesh mesh = collect(*openMeshSources({path}, mebibytes(64)));
        ASSERT_EQ(mesh.triangles.size(), corners.size() / 3);
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            TriangleCorners given{corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
            // The coder of triangles may turn them.
            for (int turn = 0; turn < 2 && !isSequence && given != mesh.triangles[i]; ++turn)
                std::rotate(given.begin(), given.begin() + 1, given.end());
            EXPECT_EQ(mesh.triangles[i], given);
        }
        for (std::size_t i = 0; i < vertices; ++i)
            EXPECT_EQ(mesh.positions[i], glm::dvec3(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]));
    }
}

TEST_F(GltfContainer, DamagedPacksAreRefused) {
    const auto refusal = [&](json how, const std::vector<unsigned char>& packed) {
        GltfMaker maker;
        maker.attributes()["POSITION"] = maker.addVectors(kCorners);
        packView(maker, 0, packed, std::move(how));
        maker.document["bufferViews"][0]["buffer"] = 0;
        return refusalOf(maker.container());
    };
    const auto holds = [](const std::string& message, const char* words) {
        EXPECT_NE(message.find(words), std::string::npos) << message;
    };
    const json good = {{"mode", "ATTRIBUTES"}, {"count", 3}, {"byteStride", 12}};
    const auto with = [&](const char* key, const json& value) {
        json changed = good;
        changed[key] = value;
        return changed;
    };
    std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(3, 12));
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), kCorners.data(), 3, 12));
    EXPECT_EQ(refusal(good, packed), "no error");
    holds(refusal(good, {1, 2, 3, 4}), "buffer view 0: the data of EXT_meshopt_compression is damaged");
    holds(refusal(with("mode", "OTHER"), packed), "EXT_meshopt_compression has invalid values");
    holds(refusal(with("byteStride", 3), packed), "EXT_meshopt_compression has invalid values");
    holds(refusal(with("byteStride", 4096), packed), "EXT_meshopt_compression has invalid values");
    holds(refusal(with("count", -3), packed), "EXT_meshopt_compression has invalid values");
    holds(refusal(with("count", 2.5), packed), "EXT_meshopt_compression has invalid values");
    holds(refusal(with("filter", "QUATERNION"), packed), "unsupported filter of EXT_meshopt_compression");
    holds(refusal(with("filter", "OCTAHEDRAL"), packed), "unsupported filter of EXT_meshopt_compression");
}

TEST_F(GltfContainer, ScenesJoinOtherInputs) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors(kCorners);
    maker.attributes()["NORMAL"] = maker.addVectors({0, 0, 1, 0, 0, 1, 0, 0, 1});
    maker.document["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"material", 0}}}}});
    maker.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}}}};
    maker.document["nodes"] = {{{"mesh", 0}, {"children", {1}}}, {{"mesh", 1}, {"translation", {0, 0, 5}}}};
    writeScratch(path, maker.container());
    writeScratch(folder + "/o.obj", "v 9 9 9\nv 8 9 9\nv 9 8 9\nf 1 2 3\n");
    const auto source = openMeshSources({folder + "/o.obj", path}, mebibytes(64));
    const CollectedMesh mesh = collect(*source);
    EXPECT_EQ(mesh.triangles, (std::vector<TriangleCorners>{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}));
    EXPECT_EQ(mesh.positions[6], glm::dvec3(0, 0, 5));
    EXPECT_TRUE(mesh.normals.empty()); // not all have them
    EXPECT_EQ(
        mesh.colors,
        (std::vector<std::uint32_t>{0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF, 0xFF000000, 0xFF000000, 0xFF000000}));
    EXPECT_TRUE(source->summary().isDouble);
    EXPECT_NO_THROW(source->requireUnchanged());
    EXPECT_NE(
        errorAbout(path, [&] { openMeshSources({path}, mebibytes(64), {"quality"}); })
            .find("only a PLY can have fields"),
        std::string::npos);
}

} // namespace
} // namespace gnomon::read
