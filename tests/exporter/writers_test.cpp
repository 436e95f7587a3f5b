// Files of a mesh whose every number is known: a .glb by the words of its format, a PLY, values and runs.
#include "core/error.h"
#include "core/random.h"
#include "hierarchy/octahedral.h"
#include "preprocess/exporter/cut_mesh.h"
#include "preprocess/exporter/field_value.h"
#include "preprocess/exporter/glb_writer.h"
#include "preprocess/exporter/ply_writer.h"
#include "preprocess/exporter/run_writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include <nlohmann/json.hpp>
#include <unistd.h>

namespace gnomon::exporter {
namespace {

using hierarchy::Field;
using hierarchy::ModelSummary;

class Writers : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove(path); }

    const std::string path = testing::TempDir() + "gnomon_writers_" +
                             testing::UnitTest::GetInstance()->current_test_info()->name() + std::to_string(::getpid());
    NoProgress progress;
};

/// A .glb taken apart.
struct Container {
    nlohmann::json document;
    std::string binary;

    template <class T>
    T at(std::size_t accessor, std::size_t value) const {
        const auto& view = document["bufferViews"][document["accessors"][accessor]["bufferView"].get<std::size_t>()];
        T result{};
        std::memcpy(&result, binary.data() + view["byteOffset"].get<std::size_t>() + value * sizeof(T), sizeof(T));
        return result;
    }
};

std::uint32_t littleWord(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
}

Container containerOf(const std::string& path) {
    const std::string bytes = readTextFile(path);
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(littleWord(bytes, 4), 2U);
    EXPECT_EQ(littleWord(bytes, 8), bytes.size());
    const std::size_t length = littleWord(bytes, 12);
    EXPECT_EQ(length % 4, 0U);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(littleWord(bytes, 20 + length), bytes.size() - 28 - length);
    EXPECT_EQ(bytes.substr(24 + length, 4), std::string("BIN\0", 4));
    return {nlohmann::json::parse(bytes.substr(20, length)), bytes.substr(28 + length)};
}

/// A mesh of random triangles with everything that a vertex can have.
CutMesh randomMesh(Random& random, std::size_t vertices, std::size_t triangles) {
    CutMesh mesh;
    mesh.fields.layout = hierarchy::FieldLayout::of(2);
    const auto coordinate = [&] { return static_cast<std::uint32_t>(random.below(1U << 20U)); };
    for (std::size_t i = 0; i < vertices; ++i) {
        hierarchy::Vertex vertex;
        vertex.position = {coordinate(), coordinate(), coordinate()};
        vertex.normal = hierarchy::packNormal({random.uniform(-1, 1), random.uniform(-1, 1), 0.5});
        vertex.color = static_cast<std::uint32_t>(random.bits());
        mesh.vertices.push_back(vertex);
        mesh.fields.words.push_back(static_cast<std::uint32_t>(random.bits()));
    }
    const auto corner = [&] { return static_cast<std::uint32_t>(random.below(vertices)); };
    for (std::size_t i = 0; i < triangles; ++i)
        mesh.triangles.push_back({corner(), corner(), corner()});
    return mesh;
}

ModelSummary fullSummary() {
    ModelSummary summary;
    summary.grid = {{0, 0, 0}, -4};
    summary.hasNormals = true;
    summary.hasColors = true;
    summary.fields = {Field{"quality", -1, 3, 16}, Field{"scan id", 0, 7, 16}};
    return summary;
}

/// sRGB (IEC 61966-2-1) back from 16 bits of linear light.
std::uint32_t levelOf(std::uint16_t linear) {
    const double value = linear / 65535.0;
    return static_cast<std::uint32_t>(
        std::lround(255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055)));
}

TEST_F(Writers, AGlbIsWhatItsFormatAsksFor) {
    Random random(4);
    const CutMesh mesh = randomMesh(random, 300, 500);
    const ModelSummary summary = fullSummary();
    writeGlb(mesh, summary, path, progress);
    const Container glb = containerOf(path);
    const nlohmann::json& all = glb.document;
    EXPECT_EQ(all["buffers"][0]["byteLength"], glb.binary.size());
    for (const auto& view : all["bufferViews"]) {
        EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0U);
        EXPECT_LE(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>(), glb.binary.size());
    }
    EXPECT_FALSE(all["nodes"][0].contains("matrix")) << "y is up, in metres, about the origin";
    const auto& attributes = all["meshes"][0]["primitives"][0]["attributes"];
    const auto place = [&](const char* name) { return attributes.at(name).get<std::size_t>(); };
    const auto indices = all["meshes"][0]["primitives"][0]["indices"].get<std::size_t>();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(glb.at<std::uint32_t>(indices, 3 * i + k), mesh.triangles[i][k]);
    std::array<float, 3> low{1e9F, 1e9F, 1e9F};
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const glm::dvec3 position = summary.grid.world(mesh.vertices[v].position);
        double length = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(glb.at<float>(place("POSITION"), 3 * v + i), position[static_cast<int>(i)]);
            low[i] = std::min(low[i], glb.at<float>(place("POSITION"), 3 * v + i));
            length += std::pow(glb.at<float>(place("NORMAL"), 3 * v + i), 2);
        }
        EXPECT_NEAR(length, 1, 1e-6);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(
                levelOf(glb.at<std::uint16_t>(place("COLOR_0"), 4 * v + i)), mesh.vertices[v].color >> 8 * i & 255U);
        EXPECT_EQ(glb.at<std::uint16_t>(place("COLOR_0"), 4 * v + 3), (mesh.vertices[v].color >> 24U) * 257);
        const std::uint32_t word = mesh.fields.words[v];
        EXPECT_FLOAT_EQ(glb.at<float>(place("_QUALITY"), v), static_cast<float>(-1 + 4 * ((word & 0xFFFFU) / 65535.0)));
        EXPECT_FLOAT_EQ(glb.at<float>(place("_SCAN_ID"), v), static_cast<float>(7 * ((word >> 16U) / 65535.0)));
    }
    EXPECT_EQ(all["accessors"][place("POSITION")]["min"], nlohmann::json(low));
}

TEST_F(Writers, APackedGlbNeedsItsExtensionAndLeavesNothingElse) {
    Random random(6);
    const CutMesh mesh = randomMesh(random, 300, 500);
    writeGlb(mesh, fullSummary(), path, progress, GlbTile{{0, 0, 0}, true});
    const Container glb = containerOf(path);
    const nlohmann::json& all = glb.document;
    EXPECT_EQ(all["extensionsRequired"], nlohmann::json({"EXT_meshopt_compression"}));
    EXPECT_EQ(all["buffers"][0]["byteLength"], glb.binary.size());
    EXPECT_FALSE(all["buffers"][1].contains("uri"));
    std::size_t end = 0;
    std::size_t unpacked = 0;
    for (const auto& view : all["bufferViews"]) {
        const auto& how = view["extensions"]["EXT_meshopt_compression"];
        EXPECT_EQ(view["buffer"], 1);
        EXPECT_EQ(how["buffer"], 0);
        EXPECT_EQ(how["byteOffset"].get<std::size_t>(), (end + 3) / 4 * 4) << "one after the other";
        EXPECT_EQ(
            how["count"].get<std::size_t>() * how["byteStride"].get<std::size_t>(),
            view["byteLength"].get<std::size_t>());
        end = how["byteOffset"].get<std::size_t>() + how["byteLength"].get<std::size_t>();
        unpacked += view["byteLength"].get<std::size_t>();
    }
    EXPECT_LE(end, glb.binary.size());
    EXPECT_EQ(all["buffers"][1]["byteLength"], unpacked);
}

TEST_F(Writers, AVertexWithoutANormalHasThatOfItsFaces) {
    CutMesh mesh;
    mesh.vertices = {{{0, 0, 0}}, {{16, 0, 0}}, {{0, 16, 0}}, {{7, 7, 7}}};
    mesh.triangles = {{0, 1, 2}};
    ModelSummary summary;
    summary.grid = {{0, 0, 0}, -4};
    summary.hasNormals = true;
    summary.up = {{1, 0, 0}};
    writeGlb(mesh, summary, path, progress);
    const Container glb = containerOf(path);
    const auto normals = glb.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"].get<std::size_t>();
    const std::array<std::array<float, 3>, 4> expected = {{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}}};
    for (std::size_t v = 0; v < 4; ++v)
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(glb.at<float>(normals, 3 * v + i), expected[v][i]) << v;
    writePly(mesh, summary, {}, path, progress);
    const std::string ply = readTextFile(path);
    const std::size_t body = ply.find("end_header\n") + 11;
    for (std::size_t v = 0; v < 4; ++v) {
        std::array<float, 6> row{};
        std::memcpy(row.data(), ply.data() + body + v * sizeof row, sizeof row);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(row[3 + i], expected[v][i]) << v;
    }
}

TEST(FieldValue, GoesFromLeastToGreatest) {
    const Field field{"f", -2, 6, 16};
    const auto layout = hierarchy::FieldLayout::of(2);
    EXPECT_EQ(fieldValue(field, layout, 0, 0), -2);
    EXPECT_EQ(fieldValue(field, layout, 0xFFFFU, 0), 6);
    EXPECT_EQ(fieldValue(field, layout, 0xFFFFU, 1), -2);
    EXPECT_EQ(fieldValue(field, layout, 0xFFFF0000U, 1), 6);
}

TEST(FieldValue, PositionsFitFloatsOrDoNot) {
    CutMesh mesh;
    mesh.vertices = {{{1, 2, 3}}};
    EXPECT_TRUE(fitsFloats(mesh, {{0, 0, 0}, -4}));
    EXPECT_FALSE(fitsFloats(mesh, {{1e7, 0, 0}, -4}));
}

TEST_F(Writers, RunsAreWrittenInOrderWhateverTheirLength) {
    Random random(5);
    std::string expected;
    {
        AtomicFile file(path);
        RunWriter out(file.file());
        for (int i = 0; i < 60; ++i) {
            const std::string text(random.below(100'000), static_cast<char>('a' + i % 26));
            out.put(text);
            expected += text;
            const auto value = static_cast<std::uint16_t>(random.bits());
            out.putValue(value);
            expected.append(reinterpret_cast<const char*>(&value), 2);
        }
        out.flush();
        file.commit();
    }
    EXPECT_EQ(readTextFile(path), expected);
}

TEST_F(Writers, APlyCannotHaveAnyName) {
    ModelSummary summary = fullSummary();
    const auto refused = [&](const char* words, std::span<const VertexValues> values) {
        try {
            writePly(CutMesh(), summary, values, path, progress);
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
            return true;
        }
        return false;
    };
    EXPECT_TRUE(refused("because of its name", {})) << "it has a blank";
    summary.fields.pop_back();
    const std::vector<VertexValues> twice = {{"quality", {}}};
    EXPECT_TRUE(refused("the model has two fields with this name", twice));
    EXPECT_FALSE(refused("", {}));
}

} // namespace
} // namespace gnomon::exporter
