// The parts of the reader of glTF, each beside a slow and plain version of itself.
#include "core/random.h"
#include "preprocess/read/gltf/base_color.h"
#include "preprocess/read/gltf/decoded_image.h"
#include "preprocess/read/gltf/gltf_accessor.h"
#include "preprocess/read/gltf/gltf_nodes.h"
#include "preprocess/read/gltf/gltf_primitive.h"
#include "preprocess/read/gltf/memory_room.h"
#include "preprocess/read/open_mesh_sources.h"
#include "tests/read/collect.h"
#include "tests/support/gltf_maker.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>

#include <png.h>
#include <turbojpeg.h>
#include <unistd.h>

namespace gnomon::read {
namespace {

using nlohmann::json;

class GltfParts : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove(path); }

    GltfFile fileOf(GltfMaker& maker) {
        writeScratch(path, maker.container());
        return {path, mebibytes(64)};
    }

    const std::string path = testing::TempDir() + "gnomon_gltf_part_" +
                             testing::UnitTest::GetInstance()->current_test_info()->name() +
                             std::to_string(::getpid()) + ".glb";
};

/// Values of one component type of glTF, and what each means as a number.
struct Typed {
    std::string bytes;
    std::vector<double> meant;
};

template <class T>
Typed typed(Random& random, std::size_t count, bool isNormalized) {
    Typed result;
    for (std::size_t i = 0; i < count; ++i) {
        const auto value = static_cast<T>(random.bits());
        result.bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
        const double one = isNormalized ? static_cast<double>(std::numeric_limits<T>::max()) : 1;
        result.meant.push_back(std::max(static_cast<double>(value) / one, isNormalized ? -1.0 : -1e9));
    }
    return result;
}

Typed typedFloats(Random& random, std::size_t count) {
    Typed result;
    for (std::size_t i = 0; i < count; ++i) {
        const auto value = static_cast<float>(random.uniform(-10, 10));
        result.bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
        result.meant.push_back(value);
    }
    return result;
}

Typed typedAs(int type, Random& random, std::size_t count, bool isNormalized) {
    if (type == TINYGLTF_COMPONENT_TYPE_BYTE) return typed<std::int8_t>(random, count, isNormalized);
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return typed<std::uint8_t>(random, count, isNormalized);
    if (type == TINYGLTF_COMPONENT_TYPE_SHORT) return typed<std::int16_t>(random, count, isNormalized);
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return typed<std::uint16_t>(random, count, isNormalized);
    return typedFloats(random, count);
}

TEST_F(GltfParts, AccessorsOfAllTypesStridesAndSparsePartsAreWhatTheirBytesMean) {
    Random random(3);
    constexpr std::array kComponentTypes = {5120, 5121, 5122, 5123, 5126};
    for (int round = 0; round < 300; ++round) {
        const int type = kComponentTypes[random.below(kComponentTypes.size())];
        const bool isNormalized = type != 5126 && random.below(2) == 0;
        const std::size_t size = type <= 5121 ? 1 : type <= 5123 ? 2 : 4;
        const std::size_t count = 1 + random.below(20);
        const Typed values = typedAs(type, random, 3 * count, isNormalized);
        const std::size_t stride = (3 * size + 3) / 4 * 4 + 4 * random.below(3);
        std::string bytes(4 * random.below(3), '?');
        const std::size_t offset = bytes.size();
        for (std::size_t i = 0; i < count; ++i) {
            bytes += values.bytes.substr(3 * size * i, 3 * size);
            if (i + 1 < count) bytes.resize(offset + (i + 1) * stride, '?');
        }
        GltfMaker maker;
        const int accessor = maker.add(std::vector<char>(bytes.begin(), bytes.end()), "VEC3", type, 1);
        json& described = maker.document["accessors"][static_cast<std::size_t>(accessor)];
        maker.document["bufferViews"][0]["byteStride"] = stride;
        described["byteOffset"] = offset;
        described["count"] = count;
        described["normalized"] = isNormalized;
        std::vector<double> expected = values.meant;
        if (random.below(2) == 0) {
            const Typed others = typedAs(type, random, 3, isNormalized);
            const auto place = static_cast<std::uint16_t>(random.below(count));
            maker.add(std::vector<char>(others.bytes.begin(), others.bytes.end()), "VEC3", type, 1);
            maker.add(std::vector<std::uint16_t>{place}, "SCALAR", 5123, 1);
            maker.document["accessors"][static_cast<std::size_t>(accessor)]["sparse"] = {
                {"count", 1},
                {"indices", {{"bufferView", 2}, {"componentType", 5123}}},
                {"values", {{"bufferView", 1}}}};
            for (std::size_t c = 0; c < 3; ++c)
                expected[place * std::size_t{3} + c] = others.meant[c];
        }
        GltfFile file = fileOf(maker);
        const std::vector<float> numbers = numbersOf(file, accessor, 3);
        ASSERT_EQ(numbers.size(), expected.size());
        for (std::size_t i = 0; i < numbers.size(); ++i)
            EXPECT_EQ(numbers[i], static_cast<float>(expected[i])) << type << " " << i;
    }
}

/// All placements below `node`, one after the other, by going down.
void placeSlowly(const json& nodes, std::size_t node, const glm::dmat4& above, std::vector<PlacedMesh>& placed) {
    const json& it = nodes[node];
    glm::dmat4 here = above;
    here = glm::translate(here, {it["translation"][0], it["translation"][1], it["translation"][2]});
    here = glm::rotate(here, it["angle"].get<double>(), glm::dvec3(0, 1, 0));
    here = glm::scale(here, {it["scale"][0], it["scale"][1], it["scale"][2]});
    placed.push_back({0, here});
    if (it.contains("children"))
        for (const json& child : it["children"])
            placeSlowly(nodes, child.get<std::size_t>(), here, placed);
}

TEST_F(GltfParts, NodesStandWhereTheirParentsPutThem) {
    Random random(5);
    for (int round = 0; round < 60; ++round) {
        GltfMaker maker;
        maker.attributes()["POSITION"] = maker.addVectors({0, 0, 0, 1, 0, 0, 0, 1, 0});
        json nodes = json::array();
        const std::size_t count = 1 + random.below(12);
        for (std::size_t i = 0; i < count; ++i) {
            const double angle = random.uniform(-3, 3);
            nodes.push_back(
                {{"mesh", 0},
                 {"angle", angle}, // for the slow version alone
                 {"rotation", {0, std::sin(angle / 2), 0, std::cos(angle / 2)}},
                 {"translation", {random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)}},
                 {"scale", {random.uniform(-2, 2), random.uniform(0.5, 2), random.uniform(0.5, 2)}}});
            if (i > 0) nodes[random.below(i)]["children"].push_back(i);
        }
        maker.document["nodes"] = nodes;
        if (random.below(2) == 0) { // no scene: all roots
            maker.document.erase("scene");
            maker.document.erase("scenes");
        }
        GltfFile file = fileOf(maker);
        const std::vector<PlacedMesh> placed = sceneOf(file).meshes;
        std::vector<PlacedMesh> expected;
        placeSlowly(nodes, 0, glm::dmat4(1), expected);
        ASSERT_EQ(placed.size(), expected.size());
        for (std::size_t i = 0; i < placed.size(); ++i)
            for (int c = 0; c < 4; ++c)
                EXPECT_LT(glm::length(placed[i].toWorld[c] - expected[i].toWorld[c]), 1e-9) << i;
    }
}

TEST_F(GltfParts, InstancesStandInTheirNode) {
    Random random(6);
    GltfMaker maker;
    const int triangle = maker.addVectors({0, 0, 0, 1, 0, 0, 0, 1, 0});
    maker.attributes()["POSITION"] = triangle;
    constexpr std::size_t kInstances = 40;
    std::vector<float> moves(3 * kInstances);
    std::vector<float> scales(3 * kInstances);
    for (float& value : moves)
        value = static_cast<float>(random.uniform(-5, 5));
    for (float& value : scales)
        value = static_cast<float>(random.uniform(0.1, 5));
    maker.document["nodes"][0]["scale"] = {2, 3, 4};
    json& attributes = maker.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    attributes["TRANSLATION"] = maker.addVectors(moves);
    attributes["SCALE"] = maker.addVectors(scales);
    GltfFile file = fileOf(maker);
    const std::vector<PlacedMesh> placed = sceneOf(file).meshes;
    ASSERT_EQ(placed.size(), kInstances);
    for (std::size_t i = 0; i < kInstances; ++i)
        for (int c = 0; c < 3; ++c) {
            const std::size_t at = 3 * i + static_cast<std::size_t>(c);
            EXPECT_DOUBLE_EQ(placed[i].toWorld[3][c], (2 + c) * double{moves[at]});
            EXPECT_DOUBLE_EQ(placed[i].toWorld[c][c], (2 + c) * double{scales[at]});
        }
    const auto complaint = [&] {
        return errorAbout(path, [&] {
            GltfFile spoiled = fileOf(maker);
            sceneOf(spoiled);
        });
    };
    attributes["SCALE"] = triangle;
    EXPECT_NE(complaint().find("the instances have different numbers of values"), std::string::npos);
    for (const double number : {2.6e35, -1.0, 1e300}) {
        attributes["SCALE"] = number;
        EXPECT_NE(complaint().find("accessor"), std::string::npos) << complaint();
    }
    attributes = {{"_BATCH", triangle}};
    EXPECT_NE(complaint().find("the instances have no transformation"), std::string::npos)
        << "else the mesh is not seen at all";
}

DecodedImage randomImage(Random& random, int width, int height) {
    DecodedImage image{width, height, {}};
    for (int i = 0; i < 4 * width * height; ++i)
        image.pixels.push_back(static_cast<std::uint8_t>(random.below(256)));
    return image;
}

std::vector<std::byte> asPng(const DecodedImage& image) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = static_cast<png_uint_32>(image.width);
    header.height = static_cast<png_uint_32>(image.height);
    header.format = PNG_FORMAT_RGBA;
    png_alloc_size_t size = 0;
    png_image_write_to_memory(&header, nullptr, &size, 0, image.pixels.data(), 0, nullptr);
    std::vector<std::byte> bytes(size);
    png_image_write_to_memory(&header, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr);
    return bytes;
}

TEST(DecodedImage, IsWhatWasEncoded) {
    Random random(8);
    MemoryRoom room("m", mebibytes(16));
    for (int round = 0; round < 20; ++round) {
        const DecodedImage image =
            randomImage(random, 1 + static_cast<int>(random.below(40)), 1 + static_cast<int>(random.below(40)));
        const DecodedImage decoded = decodedImage(asPng(image), room, "x");
        EXPECT_EQ(decoded.width, image.width);
        EXPECT_EQ(decoded.height, image.height);
        EXPECT_EQ(decoded.pixels, image.pixels);
    }
    std::vector<std::uint8_t> grey(std::size_t{64} * 64 * 4, 90);
    unsigned char* encoded = nullptr;
    unsigned long size = 0;
    void* const writer = tjInitCompress();
    ASSERT_EQ(tjCompress2(writer, grey.data(), 64, 0, 64, TJPF_RGBA, &encoded, &size, TJSAMP_444, 95, 0), 0);
    const auto* const bytes = reinterpret_cast<const std::byte*>(encoded);
    const DecodedImage decoded = decodedImage({bytes, size}, room, "x");
    EXPECT_EQ(decoded.width, 64);
    for (std::size_t i = 0; i < decoded.pixels.size(); ++i)
        EXPECT_NEAR(decoded.pixels[i], i % 4 == 3 ? 255 : 90, 1);
    EXPECT_NE(
        errorAbout(
            "x",
            [&] {
                decodedImage({bytes, 30}, room, "x");
            })
            .find("the JPEG is damaged"),
        std::string::npos);
    tjFree(encoded);
    tjDestroy(writer);
}

TEST(DecodedImage, OneThatClaimsMoreThanThereIsRoomForIsNotUnpacked) {
    Random random(9);
    std::vector<std::byte> png = asPng(randomImage(random, 300, 300));
    constexpr std::uint64_t kBytes = 360'000; // 300 by 300 pixels
    MemoryRoom room("m", {kBytes - 1});
    EXPECT_NE(errorAbout("x", [&] { decodedImage(png, room, "x"); }).find("a need for"), std::string::npos);
    MemoryRoom sufficient("m", {kBytes + 300 * sizeof(void*)}); // with the places of its rows
    EXPECT_EQ(decodedImage(png, sufficient, "x").pixels.size(), kBytes);
    EXPECT_EQ(sufficient.taken().count, kBytes);
    const std::vector<std::byte> text(100, std::byte{'a'});
    EXPECT_NE(errorAbout("x", [&] { decodedImage(text, sufficient, "x"); }).find("a PNG or a JPEG"), std::string::npos);
}

TEST(MemoryRoom, HoldsAProductThatOverflows) {
    MemoryRoom room("m", {1000});
    room.take(10, 100);
    EXPECT_NE(errorAbout("m", [&] { room.take(1); }), "no error");
    room.give(500);
    room.take(250, 2);
    room.take(0, 1U << 30U);
    room.take(~std::uint64_t{0}, 0);
    EXPECT_NE(errorAbout("m", [&] { room.take(std::uint64_t{1} << 63U, 2); }), "no error");
}

/// The texel at whole-number place (x, y) of the endless plane, by stepping there.
int steppedTo(int at, int size, int wrap) {
    if (wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return std::clamp(at, 0, size - 1);
    int texel = 0;
    int step = 1;
    const auto next = [&] {
        texel += step;
        if (texel >= 0 && texel < size) return;
        if (wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) {
            texel -= step; // the texel at the edge is shown twice
            step = -step;
        } else {
            texel = step > 0 ? 0 : size - 1;
        }
    };
    if (at < 0) {
        step = -1;
        for (int i = 0; i > at; --i)
            next();
    } else {
        for (int i = 0; i < at; ++i)
            next();
    }
    return texel;
}

double linearOfByte(std::uint8_t byte) {
    const double display = byte / 255.0;
    return display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
}

TEST(BaseTexture, LiesBetweenTheFourTexelsAround) {
    Random random(10);
    constexpr std::array kWraps = {
        TINYGLTF_TEXTURE_WRAP_REPEAT, TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE, TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT};
    for (int round = 0; round < 2000; ++round) {
        BaseTexture texture;
        texture.image =
            randomImage(random, 1 + static_cast<int>(random.below(5)), 1 + static_cast<int>(random.below(5)));
        texture.wraps = {kWraps[random.below(3)], kWraps[random.below(3)]};
        const glm::dvec2 uv(random.uniform(-3, 3), random.uniform(-3, 3));
        glm::dvec4 expected(0);
        const glm::dvec2 place(uv.x * texture.image.width - 0.5, uv.y * texture.image.height - 0.5);
        for (int y = static_cast<int>(std::floor(place.y)); y <= std::floor(place.y) + 1; ++y)
            for (int x = static_cast<int>(std::floor(place.x)); x <= std::floor(place.x) + 1; ++x) {
                const int column = steppedTo(x, texture.image.width, texture.wraps[0]);
                const int row = steppedTo(y, texture.image.height, texture.wraps[1]);
                const std::size_t first = std::size_t{4} * static_cast<std::size_t>(row * texture.image.width + column);
                const double share = (1 - std::abs(x - place.x)) * (1 - std::abs(y - place.y));
                for (int c = 0; c < 4; ++c) {
                    const std::uint8_t byte = texture.image.pixels[first + static_cast<std::size_t>(c)];
                    expected[c] += share * (c < 3 ? linearOfByte(byte) : byte / 255.0);
                }
            }
        EXPECT_LT(glm::length(texture.at(uv) - expected), 1e-9) << uv.x << " " << uv.y;
    }
}

TEST(BaseTexture, ColoursComeBackAsTheyWere) {
    for (int byte = 0; byte < 256; ++byte) {
        const double linear = linearOfByte(static_cast<std::uint8_t>(byte));
        const auto grey = static_cast<std::uint32_t>(byte);
        EXPECT_EQ(packedColor(glm::dvec4(linear, linear, linear, byte / 255.0)), grey * 0x01010101U);
    }
    const double none = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(packedColor({none, -1, 2, 1e300}), 0xFFFF0000U);
}

TEST_F(GltfParts, TextureTransformsScaleTurnAndMove) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors({0, 0, 0, 1, 0, 0, 0, 1, 0});
    maker.document["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorTexture",
            {{"index", 0},
             {"texCoord", 1},
             {"extensions",
              {{"KHR_texture_transform",
                {{"offset", {0.5, 0.25}}, {"rotation", 1.5707963267948966}, {"scale", {2, 3}}}}}}}}}}}};
    GltfFile file = fileOf(maker);
    const BaseColor color = baseColorOf(file, 0);
    EXPECT_EQ(color.texCoord, 1);
    // A quarter turn: u goes to -v, v to u.
    const glm::dvec2 moved = color.toImage * glm::dvec3(0.1, 0.2, 1);
    EXPECT_NEAR(moved.x, 0.5 + 3 * 0.2, 1e-12);
    EXPECT_NEAR(moved.y, 0.25 - 2 * 0.1, 1e-12);
    EXPECT_EQ(baseColorOf(file, -1).factor, glm::dvec4(1));
    json& texture = maker.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    texture["extensions"]["KHR_texture_transform"]["texCoord"] = 3;
    EXPECT_EQ(baseColorOf(fileOf(maker), 0).texCoord, 3) << "it replaces that of the texture";
    EXPECT_EQ(baseColorOf(fileOf(maker), 0).toImage, color.toImage);
    texture["extensions"]["KHR_texture_transform"] = {{"texCoord", 0}};
    EXPECT_EQ(baseColorOf(fileOf(maker), 0).texCoord, 0);
}

TEST_F(GltfParts, DiffuseColoursOfSpecularGlossinessReplaceBaseColours) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const auto colorWith = [&](const json& specular) {
        maker.document["materials"] = {
            {{"alphaMode", "MASK"},
             {"pbrMetallicRoughness",
              {{"baseColorFactor", {0, 0, 1, 1}}, {"baseColorTexture", {{"index", 7}, {"texCoord", 2}}}}}}};
        if (!specular.is_null())
            maker.document["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = specular;
        maker.document["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
        return baseColorOf(fileOf(maker), 0);
    };
    EXPECT_EQ(colorWith(nullptr).factor, glm::dvec4(0, 0, 1, 1));
    EXPECT_EQ(colorWith(nullptr).texture, 7);
    const BaseColor factor = colorWith({{"diffuseFactor", {1, 0.5, 0.25, 0.125}}, {"specularFactor", {0, 0, 0}}});
    EXPECT_EQ(factor.factor, glm::dvec4(1, 0.5, 0.25, 0.125));
    EXPECT_EQ(factor.texture, -1);
    EXPECT_TRUE(factor.isClear);
    const BaseColor plain = colorWith(json::object());
    EXPECT_EQ(plain.factor, glm::dvec4(1));
    EXPECT_EQ(plain.texture, -1);
    const BaseColor texture = colorWith({{"diffuseTexture", {{"index", 3}, {"texCoord", 1}}}});
    EXPECT_EQ(texture.factor, glm::dvec4(1));
    EXPECT_EQ(texture.texture, 3);
    EXPECT_EQ(texture.texCoord, 1);
    const BaseColor moved = colorWith(
        {{"diffuseTexture",
          {{"index", 3},
           {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}, {"scale", {2, 4}}, {"texCoord", 5}}}}}}}});
    EXPECT_EQ(moved.texCoord, 5);
    EXPECT_EQ(moved.toImage * glm::dvec3(1, 1, 1), glm::dvec2(2.5, 4));
}

/// The matrix of a quaternion of unit length, by its formula.
glm::dmat3 matrixOf(const std::array<double, 4>& q) {
    const auto& [x, y, z, w] = q;
    return {
        1 - 2 * (y * y + z * z),
        2 * (x * y + z * w),
        2 * (x * z - y * w), //
        2 * (x * y - z * w),
        1 - 2 * (x * x + z * z),
        2 * (y * z + x * w), //
        2 * (x * z + y * w),
        2 * (y * z - x * w),
        1 - 2 * (x * x + y * y),
    };
}

void expectTurned(const glm::dmat4& found, const glm::dmat3& expected, double within) {
    for (int c = 0; c < 3; ++c)
        EXPECT_LT(glm::length(glm::dvec3(found[c]) - expected[c]), within) << c;
}

TEST_F(GltfParts, RotationsOfAnyLengthAndTypeTurnWithoutScaling) {
    Random random(12);
    for (int round = 0; round < 100; ++round) {
        std::array<double, 4> unit{};
        double length = 0;
        while (length < 0.1) {
            for (double& part : unit)
                part = random.uniform(-1, 1);
            length = std::sqrt(unit[0] * unit[0] + unit[1] * unit[1] + unit[2] * unit[2] + unit[3] * unit[3]);
        }
        for (double& part : unit)
            part /= length;
        const double scale = std::pow(10, round < 50 ? random.uniform(-20, 20) : random.uniform(-307, 307));
        GltfMaker maker;
        maker.attributes()["POSITION"] = maker.addVectors({0, 0, 0, 1, 0, 0, 0, 1, 0});
        json& node = maker.document["nodes"][0];
        node["rotation"] = {scale * unit[0], scale * unit[1], scale * unit[2], scale * unit[3]};
        GltfFile file = fileOf(maker);
        expectTurned(sceneOf(file).meshes.at(0).toWorld, matrixOf(unit), 1e-12);
        node.erase("rotation");
        json& rotation = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"];
        std::vector<std::int8_t> bytes;
        std::vector<std::int16_t> words;
        for (const double part : unit) {
            bytes.push_back(static_cast<std::int8_t>(std::lround(127 * part)));
            words.push_back(static_cast<std::int16_t>(std::lround(32767 * part)));
        }
        for (const bool isByte : {true, false}) {
            rotation = isByte ? maker.add(bytes, "VEC4", 5120, 4) : maker.add(words, "VEC4", 5122, 4);
            maker.document["accessors"].back()["normalized"] = true;
            GltfFile quantised = fileOf(maker);
            const glm::dmat4 toWorld = sceneOf(quantised).meshes.at(0).toWorld;
            expectTurned(toWorld, matrixOf(unit), isByte ? 0.03 : 1e-4);
            EXPECT_NEAR(glm::determinant(glm::dmat3(toWorld)), 1, 1e-12) << "it neither scales nor shears";
        }
    }
}

TEST_F(GltfParts, ScalesOfAnySizeTurnNormalsAndMirrorFaces) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors({0, 0, 0, 1, 0, 0, 0, 1, 0});
    maker.attributes()["NORMAL"] = maker.addVectors({0, 0, 1, 0, 0, 1, 0, 0, 1});
    for (const double size : {1e-200, 1.0, 1e90, 1e200}) {
        maker.document["nodes"][0]["scale"] = {size, size, -size};
        writeScratch(path, maker.container());
        const auto source = openMeshSources({path}, mebibytes(64));
        source->readVertices([](const VertexBlock& block) { EXPECT_EQ(block.normals[0], glm::vec3(0, 0, -1)); });
        source->readTriangles([](const TriangleBlock& block) {
            EXPECT_EQ(block.triangles[0], (TriangleCorners{0, 2, 1}));
        });
    }
}

TEST_F(GltfParts, TransformsThatAreNoneAreToldOrRefused) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors({0, 0, 0, 1, 0, 0, 0, 1, 0});
    json& node = maker.document["nodes"][0];
    node["rotation"] = {0, 0, 0, 0};
    node["scale"] = {2, 2, 2};
    GltfFile file = fileOf(maker);
    const GltfScene scene = sceneOf(file);
    expectTurned(scene.meshes.at(0).toWorld, glm::dmat3(2), 1e-12);
    EXPECT_EQ(scene.rejected, (std::map<std::string, std::uint64_t>{{"rotations of length 0", 1}}));
    for (const auto& [name, count] :
         {std::pair("rotation", 3), std::pair("translation", 2), std::pair("scale", 4), std::pair("matrix", 15)}) {
        node = {{"mesh", 0}, {name, std::vector<double>(static_cast<std::size_t>(count), 1.0)}};
        const std::string message = errorAbout(path, [&] {
            GltfFile spoiled = fileOf(maker);
            sceneOf(spoiled);
        });
        EXPECT_NE(message.find("node 0: its " + std::string(name) + " cannot be understood"), std::string::npos)
            << message;
    }
}

/// A document with a camera for each of `nodes`, all in one scene.
GltfMaker makerOfCameras(const json& cameras, const json& nodes, const json& roots) {
    GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors({0, 0, 0, 1, 0, 0, 0, 1, 0});
    maker.document["cameras"] = cameras;
    maker.document["nodes"] = nodes;
    maker.document["scenes"][0]["nodes"] = roots;
    return maker;
}

const json kPerspective = {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}};

TEST_F(GltfParts, CamerasShowThePointsBeforeTheirNodes) {
    Random random(13);
    for (int round = 0; round < 100; ++round) {
        // Below any chain of turned, moved and evenly scaled nodes. An odd number of mirrors mirrors the picture.
        json nodes = json::array();
        glm::dmat4 toWorld(1);
        const std::size_t depth = 1 + random.below(4);
        for (std::size_t i = 0; i < depth; ++i) {
            const glm::dvec3 move(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9));
            const double angle = random.uniform(-3, 3);
            const double size = random.uniform(0.2, 3);
            const double mirror = random.below(3) == 0 ? -1 : 1;
            toWorld = glm::translate(toWorld, move);
            toWorld = glm::rotate(toWorld, angle, glm::dvec3(0, 0.6, 0.8));
            toWorld = glm::scale(toWorld, glm::dvec3(mirror * size, size, size));
            nodes.push_back(
                {{"translation", {move.x, move.y, move.z}},
                 {"rotation", {0, 0.6 * std::sin(angle / 2), 0.8 * std::sin(angle / 2), std::cos(angle / 2)}},
                 {"scale", {mirror * size, size, size}},
                 {"children", {i + 1}}});
        }
        nodes.push_back({{"camera", 0}});
        nodes.push_back({{"mesh", 0}});
        GltfMaker maker = makerOfCameras(json::array({kPerspective}), nodes, {0, depth + 1});
        GltfFile file = fileOf(maker);
        const GltfScene scene = sceneOf(file);
        ASSERT_EQ(scene.cameras.size(), 1U);
        EXPECT_TRUE(scene.rejected.empty());
        const Camera& camera = scene.cameras[0];
        EXPECT_EQ(camera.projection, Projection::Perspective);
        EXPECT_EQ(camera.fovYRadians, 0.8);
        EXPECT_LT(glm::length(camera.eye - glm::dvec3(toWorld[3])), 1e-9);
        const CameraBasis basis = cameraBasis(camera);
        const double side = glm::determinant(glm::dmat3(toWorld)) < 0 ? -1 : 1;
        for (int i = 0; i < 5; ++i) {
            const glm::dvec3 point(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-9, -1));
            const glm::dvec3 seen = toCamera(basis, glm::dvec3(toWorld * glm::dvec4(point, 1)) - camera.eye);
            EXPECT_NEAR(seen.x / seen.z, side * point.x / -point.z, 1e-9);
            EXPECT_NEAR(seen.y / seen.z, point.y / -point.z, 1e-9);
            EXPECT_GT(seen.z, 0);
        }
    }
}

TEST_F(GltfParts, OrthographicCamerasShowTheirHeight) {
    const json parallel = {
        {"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 2.5}, {"zfar", 9}, {"znear", 0}}}};
    GltfMaker maker = makerOfCameras(
        json::array({parallel}),
        {{{"camera", 0}, {"translation", {1, 2, 3}}, {"scale", {4, 4, 4}}}, {{"mesh", 0}}},
        {0, 1});
    GltfFile file = fileOf(maker);
    const std::vector<Camera> cameras = sceneOf(file).cameras;
    ASSERT_EQ(cameras.size(), 1U);
    EXPECT_TRUE(cameras[0].isParallel());
    EXPECT_NEAR(halfHeightAtTarget(cameras[0]), 2.5, 1e-12) << "the node's scale does not change it";
    EXPECT_EQ(cameras[0].eye, glm::dvec3(1, 2, 3));
    EXPECT_NEAR(cameras[0].target.x, 1, 1e-12);
    EXPECT_NEAR(cameras[0].target.y, 2, 1e-12);
    EXPECT_LT(cameras[0].target.z, 3);
}

TEST_F(GltfParts, CamerasComeInTheOrderOfTheFileAndTheRestIsCounted) {
    const auto turned = [](double angle) {
        json camera = kPerspective;
        camera["perspective"]["yfov"] = angle;
        return camera;
    };
    const auto found = [&](const json& cameras, const json& nodes, const json& roots) {
        GltfMaker maker = makerOfCameras(cameras, nodes, roots);
        writeScratch(path, maker.container());
        const MeshSummary summary = openMeshSources({path}, mebibytes(64))->summary();
        std::vector<double> angles;
        for (const Camera& camera : summary.cameras)
            angles.push_back(camera.fovYRadians);
        return std::pair(angles, summary.attributesDropped);
    };
    using Found = std::pair<std::vector<double>, std::map<std::string, std::uint64_t>>;
    const json parallel = {
        {"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 9}, {"znear", 0}}}};
    const json mesh = {{"mesh", 0}};
    const auto at = [](int camera) { return json{{"camera", camera}}; };
    const auto list = [](const std::vector<json>& entries) { return json(entries); };
    EXPECT_EQ(found(list({turned(0.1), turned(0.2)}), list({at(1), at(0), mesh}), {0, 1, 2}), (Found{{0.1, 0.2}, {}}));
    EXPECT_EQ(found(list({turned(0.1)}), list({at(0), at(0), mesh}), {0, 1, 2}), (Found{{0.1, 0.1}, {}}));
    EXPECT_EQ(found(list({turned(0.1), turned(0.2)}), list({at(1), mesh}), {0, 1}), (Found{{0.2}, {{"cameras", 1}}}));
    EXPECT_EQ(
        found(list({turned(0.1)}), list({at(0), mesh}), list({1})),
        (Found{{}, {{"cameras", 1}, {"nodes of other scenes", 1}}}));
    EXPECT_EQ(found(list({turned(0.1)}), list({at(7), mesh}), {0, 1}), (Found{{}, {{"cameras", 1}}}))
        << "there is no such camera";
    EXPECT_EQ(
        found(list({parallel, turned(0.1)}), list({at(0), at(1), mesh}), {0, 1, 2}),
        (Found{{0.1}, {{"orthographic cameras", 1}}}));
    EXPECT_EQ(found(list({parallel}), list({at(0), mesh}), {0, 1}).first.size(), 1U);
    const json flat = {{"camera", 0}, {"scale", {1, 1, 0}}};
    EXPECT_EQ(found(list({turned(0.1)}), list({flat, mesh}), {0, 1}), (Found{{}, {{"cameras", 1}}}))
        << "it looks nowhere";
    for (const json& none : {turned(0), turned(-1), turned(4), json{{"type", "fisheye"}}, json::object(), json(3)})
        EXPECT_EQ(found(list({none}), list({at(0), mesh}), {0, 1}), (Found{{}, {{"cameras", 1}}})) << none;
    json many = json::array();
    json nodes = list({mesh});
    json roots = list({0});
    for (int i = 0; i < 1030; ++i) {
        many.push_back(turned(0.001 * (i + 1)));
        nodes.push_back(at(i));
        roots.push_back(i + 1);
    }
    EXPECT_EQ(found(many, nodes, roots).first.size(), 1024U);
    EXPECT_EQ(found(many, nodes, roots).second, (std::map<std::string, std::uint64_t>{{"cameras", 6}}));
}

TEST_F(GltfParts, PrimitivesOfPointsAndLinesAreLeftOutAndCounted) {
    for (const int mode : {0, 1, 2, 3}) {
        GltfMaker maker;
        maker.attributes()["POSITION"] = maker.addVectors({0, 0, 0, 1, 0, 0, 0, 1, 0});
        maker.primitive()["mode"] = mode;
        GltfFile file = fileOf(maker);
        GltfPrimitives primitives(file, true);
        EXPECT_FALSE(primitives.read(file.model().meshes[0].primitives[0]));
        EXPECT_EQ(primitives.rejected().at(mode == 0 ? "primitives of points" : "primitives of lines"), 1U);
    }
}

} // namespace
} // namespace gnomon::read
