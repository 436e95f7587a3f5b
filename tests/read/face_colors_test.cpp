// Faces with colours: every corner has its face's, and a vertex is split only where its faces differ.
#include "collect.h"
#include "core/random.h"
#include "preprocess/read/face_color_splitter.h"
#include "preprocess/read/open_mesh_sources.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <sstream>

#include <unistd.h>

namespace gnomon::read {
namespace {

std::string scratchFaces(const std::string& name) {
    return testing::TempDir() + "gnomon_face_colors_" + std::to_string(::getpid()) + "_" + name + ".ply";
}

std::unique_ptr<MeshSource> opened(const std::string& name, const std::string& text, Bytes limit = gibibytes(1)) {
    writeScratch(scratchFaces(name), text);
    return openMeshSources({scratchFaces(name)}, limit);
}

struct Face {
    std::vector<std::int32_t> corners;
    std::array<std::uint8_t, 3> color{};
};

constexpr std::int32_t kFaceVertices = 60;

std::vector<Face> randomFaces(std::uint64_t seed) {
    Random random(seed);
    std::vector<Face> faces(200);
    for (Face& face : faces) {
        for (std::uint64_t i = 0; i < 3 + random.below(3); ++i)
            face.corners.push_back(static_cast<std::int32_t>(random.below(kFaceVertices)));
        face.color = {static_cast<std::uint8_t>(random.below(3) * 100), 7, 255};
    }
    return faces;
}

template <class T>
void put(std::string& text, T value) {
    std::array<char, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), &value, sizeof(T));
    text.append(bytes.data(), bytes.size());
}

/// Vertex v lies at (v, 2 v, 0).
std::string plyOf(const std::vector<Face>& faces, bool isBinary) {
    std::ostringstream head;
    head << "ply\nformat " << (isBinary ? "binary_little_endian" : "ascii") << " 1.0\nelement vertex " << kFaceVertices
         << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << faces.size()
         << "\nproperty uchar red\nproperty list uchar int vertex_indices\nproperty uchar green\nproperty uchar blue\n"
            "end_header\n";
    std::string text = head.str();
    std::ostringstream rows;
    for (std::int32_t v = 0; v < kFaceVertices; ++v) {
        rows << v << ' ' << 2 * v << " 0\n";
        if (!isBinary) continue;
        put(text, static_cast<float>(v));
        put(text, 2 * static_cast<float>(v));
        put(text, 0.0F);
    }
    for (const Face& face : faces) {
        rows << int{face.color[0]} << ' ' << face.corners.size();
        for (const std::int32_t corner : face.corners)
            rows << ' ' << corner;
        rows << ' ' << int{face.color[1]} << ' ' << int{face.color[2]} << '\n';
        if (!isBinary) continue;
        put(text, face.color[0]);
        put(text, static_cast<std::uint8_t>(face.corners.size()));
        for (const std::int32_t corner : face.corners)
            put(text, corner);
        put(text, face.color[1]);
        put(text, face.color[2]);
    }
    return isBinary ? text : text + rows.str();
}

/// Where the corners of `mesh` lie and their colours, each held beside the face that it comes from.
std::set<std::pair<double, std::uint32_t>> usedCorners(const std::vector<Face>& faces, const CollectedMesh& mesh) {
    std::size_t t = 0;
    std::set<std::pair<double, std::uint32_t>> used;
    for (const Face& face : faces) {
        const std::uint32_t color =
            0xFF000000U | std::uint32_t{face.color[2]} << 16U | std::uint32_t{face.color[1]} << 8U | face.color[0];
        for (std::size_t i = 2; i < face.corners.size(); ++i, ++t) {
            const std::array<std::int32_t, 3> fan = {face.corners[0], face.corners[i - 1], face.corners[i]};
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_EQ(mesh.positions[mesh.triangles[t][k]].x, fan[k]);
                EXPECT_EQ(mesh.colors[mesh.triangles[t][k]], color);
                used.insert({fan[k], color});
            }
        }
    }
    EXPECT_EQ(t, mesh.triangles.size());
    return used;
}

TEST(FaceColors, EveryCornerHasItsFacesAndNoVertexIsThereTwice) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const std::vector<Face> faces = randomFaces(seed);
        const auto source = opened("random", plyOf(faces, seed % 2 == 0));
        EXPECT_TRUE(source->summary().hasColors);
        EXPECT_TRUE(source->summary().attributesDropped.empty()) << "the colours are kept";
        const CollectedMesh mesh = collect(*source);
        std::set<std::pair<double, std::uint32_t>> vertices;
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            EXPECT_EQ(mesh.positions[v].y, 2 * mesh.positions[v].x);
            EXPECT_TRUE(vertices.insert({mesh.positions[v].x, mesh.colors[v]}).second);
        }
        EXPECT_EQ(usedCorners(faces, mesh), vertices);
    }
}

constexpr const char* kStart = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                               "property float z\n";

TEST(FaceColors, MayHaveAnAlphaAndBeFloats) {
    const auto source = opened(
        "alpha",
        std::string(kStart) +
            "element face 1\nproperty list uchar int vertex_indices\nproperty float red\nproperty float green\n"
            "property float blue\nproperty uchar alpha\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 0.5 0 64\n");
    for (const std::uint32_t color : collect(*source).colors)
        EXPECT_EQ(color, 0x400080FFU);
}

TEST(FaceColors, GiveWayToColoursOfVerticesAndAreCounted) {
    const auto source = opened(
        "both",
        std::string(kStart) +
            "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float quality\nelement face 1\n"
            "property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
            "end_header\n0 0 0 9 9 9 1\n1 0 0 9 9 9 1\n0 1 0 9 9 9 1\n3 0 1 2 50 60 70\n");
    for (const std::uint32_t color : collect(*source).colors)
        EXPECT_EQ(color, 0xFF090909U);
    const std::map<std::string, std::uint64_t> dropped = {{"vertex quality", 3}, {"face colours", 1}};
    EXPECT_EQ(source->summary().attributesDropped, dropped);
}

TEST(FaceColors, TooManyForTheMemoryAreRefused) {
    const std::string text = plyOf(randomFaces(1), true);
    EXPECT_EQ(errorAbout(scratchFaces("limit"), [&] { opened("limit", text); }), "no error");
    EXPECT_EQ(
        errorAbout(scratchFaces("limit"), [&] { opened("limit", text, {4096}); })
            .find(": too large: face colours are read into memory as a whole (vertex colours are streamed): "),
        0U);
    EXPECT_NE(
        errorAbout(scratchFaces("short"), [&] { opened("short", text.substr(0, text.size() - 1)); })
            .find("ends too early"),
        std::string::npos);
}

TEST(FaceColors, ASplitterKeepsNormalsBesidePositions) {
    FaceColorSplitter splitter("a file", gibibytes(1), {"quality"});
    const std::array<glm::dvec3, 3> positions = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    const std::array<glm::vec3, 3> normals = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const std::array<double, 3> quality = {7, 8, 9};
    splitter.addVertices({0, positions, normals, {}, quality});
    const std::array<std::uint64_t, 3> face = {0, 1, 2};
    splitter.addFace(face, 5);
    splitter.addFace(face, 6);
    const MemoryMesh mesh = splitter.take();
    ASSERT_EQ(mesh.positions.size(), 6U);
    for (std::size_t v = 0; v < 6; ++v) {
        EXPECT_EQ(mesh.positions[v], positions[v / 2]);
        EXPECT_EQ(mesh.normals[v], normals[v / 2]);
        EXPECT_EQ(mesh.colors[v], 5 + v % 2);
        EXPECT_EQ(mesh.fields[v], quality[v / 2]);
    }
}

} // namespace
} // namespace gnomon::read
