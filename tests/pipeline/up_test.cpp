// Which way is up: what a build guesses from shapes, what it reads of its sources, and that neither moves a triangle.
#include "core/random.h"
#include "hierarchy/coarse_cut.h"
#include "hierarchy/up_guess.h"
#include "hierarchy/upright_frame.h"
#include "preprocess/pipeline/source_up.h"
#include "preprocess/pipeline/upright_model.h"
#include "tests/pipeline/built_model.h"
#include "tests/pipeline/test_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace gnomon::pipeline {
namespace {

constexpr std::array kAxisNames = {"x", "y", "z", "-x", "-y", "-z"};

struct Shape {
    std::vector<glm::dvec3> positions;
    std::vector<read::CodeMesh::Triangle> triangles;

    read::CodeMesh source() const { return {positions, triangles}; }
};

/// Adds one side of the box, across `axis`, in a grid of squares.
void addSide(Shape& mesh, const glm::dvec3& low, const glm::dvec3& high, int axis, bool isHigh, int squares) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (int j = 0; j <= squares; ++j)
        for (int i = 0; i <= squares; ++i) {
            glm::dvec3 p = isHigh ? high : low;
            p[u] = low[u] + (high[u] - low[u]) * i / squares;
            p[v] = low[v] + (high[v] - low[v]) * j / squares;
            mesh.positions.push_back(p);
        }
    const auto row = static_cast<std::uint32_t>(squares + 1);
    for (std::uint32_t j = 0; j + 1 < row; ++j)
        for (std::uint32_t i = 0; i + 1 < row; ++i) {
            const std::uint32_t a = first + j * row + i;
            const std::uint32_t b = isHigh ? a + 1 : a + row;
            const std::uint32_t c = isHigh ? a + row : a + 1;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({b, a + row + 1, c});
        }
}

/// Adds a closed box, each side in a grid of squares.
void addBox(Shape& mesh, const glm::dvec3& low, const glm::dvec3& high, int squares = 3) {
    for (int axis = 0; axis < 3; ++axis)
        for (const bool isHigh : {false, true})
            addSide(mesh, low, high, axis, isHigh, squares);
}

/// A heap of boxes, smaller the higher they lie, y up, of a seeded shape.
Shape heap(std::uint64_t seed) {
    Random random(seed);
    Shape mesh;
    double low = 0;
    for (int layer = 0; layer < 6; ++layer) {
        const double width = (1 - 0.15 * layer) * random.uniform(0.9, 1.1);
        const double depth = (0.8 - 0.11 * layer) * random.uniform(0.9, 1.1);
        const double high = low + random.uniform(0.12, 0.2);
        const double aside = random.uniform(-0.05, 0.05);
        addBox(mesh, {aside - width, low, -depth}, {aside + width, high, depth});
        low = high;
    }
    return mesh;
}

/// `mesh`, which has y up, in a world where `up` is.
Shape turned(Shape mesh, const glm::dvec3& up) {
    const hierarchy::UprightFrame frame = hierarchy::uprightFrame(up);
    for (glm::dvec3& position : mesh.positions)
        position = frame.toWorld(position);
    return mesh;
}

std::string upOf(const Shape& mesh) {
    return hierarchy::upAxisText(BuiltModel(mesh.source()).summary().up);
}

TEST(Up, WhatStandsIsSeenToStandInAllSixAxes) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
        for (const char* name : kAxisNames) {
            const BuiltModel model(turned(heap(seed), hierarchy::upAxisNamed(name)->direction).source());
            EXPECT_EQ(hierarchy::upAxisText(model.summary().up), name) << seed;
            EXPECT_TRUE(model.report().upBecause.starts_with("guessed: it stands on ")) << model.report().upBecause;
            EXPECT_EQ(model.summary().options.contains("up"), std::string(name) != "y") << "hashes of y stay";
        }
}

TEST(Up, WhatMayAsWellBeUprightStaysSo) {
    Shape wall; // that faces z, or lies with z up: nobody knows
    addBox(wall, {0, 0, 0}, {8, 5, 0.3}, 8);
    EXPECT_EQ(upOf(wall), "y");
    Shape cupboard;
    addBox(cupboard, {0, 0, 0}, {1000, 2000, 400}, 8);
    EXPECT_EQ(upOf(cupboard), "y");
    Shape tree; // higher up than wide below
    addBox(tree, {-0.1, 0, -0.1}, {0.1, 2, 0.1});
    addBox(tree, {-1, 2, -1}, {1, 4, 1}, 6);
    EXPECT_EQ(upOf(tree), "y");
    EXPECT_EQ(upOf({read::bumpySheet(30).positions, read::bumpySheet(30).triangles}), "y") << "as small as a wall";
    Shape ball;
    addBox(ball, {-1, -1, -1}, {1, 1, 1}, 8);
    for (glm::dvec3& position : ball.positions)
        position = glm::normalize(position);
    EXPECT_EQ(upOf(ball), "y");
}

TEST(Up, LandAndFloorsHaveZUpWhereTheySaySo) {
    Shape land;
    addBox(land, {0, 0, 0}, {1, 1, 1}, 20);
    constexpr std::size_t kSide = std::size_t{21} * 21;
    land.positions = {land.positions.begin() + 5 * kSide, land.positions.end()}; // its top alone
    land.triangles.resize(std::size_t{2} * 20 * 20);
    Random random(3);
    for (glm::dvec3& position : land.positions)
        position = {5000 * position.x, 4000 * position.y, random.uniform(0, 30)};
    EXPECT_EQ(upOf(land), "z");
    for (glm::dvec3& position : land.positions)
        position /= 100;
    EXPECT_EQ(upOf(land), "y") << "a wall might be as large";
    Shape house;
    for (int storey = 0; storey < 4; ++storey) {
        const double z = 4.0 * storey;
        const double in = storey == 0 ? 6 : 0; // a ground floor that is smaller, so that it stands on little
        addBox(house, {in, in, z}, {20 - in, 16 - in, z + 0.3});
        addBox(house, {in, in, z}, {20 - in, in + 0.2, z + 4});
        addBox(house, {in, 15.8 - in, z}, {20 - in, 16 - in, z + 4});
        addBox(house, {in, in, z}, {in + 0.2, 16 - in, z + 4});
        addBox(house, {19.8 - in, in, z}, {20 - in, 16 - in, z + 4});
    }
    addBox(house, {9, -4, 8}, {11, 0, 8.3}); // a balcony, on which it does not stand either
    EXPECT_EQ(upOf(house), "z");
}

TEST(Up, NoWordOfItMovesATriangle) {
    const Shape mesh = turned(heap(7), {0, 0, 1});
    const BuiltModel guessed(mesh.source());
    BuildOptions options;
    options.up = *hierarchy::upAxisNamed("-x");
    options.unit = hierarchy::Unit::Foot;
    options.threads = 1;
    const BuiltModel told(mesh.source(), options);
    EXPECT_EQ(hierarchy::upAxisText(told.summary().up), "-x");
    EXPECT_EQ(told.summary().unit, hierarchy::Unit::Foot);
    EXPECT_EQ(told.summary().options.at("up"), "as asked");
    ASSERT_EQ(told.pages().size(), guessed.pages().size());
    for (std::size_t i = 0; i < told.pages().size(); ++i) {
        EXPECT_EQ(told.pages()[i].triangles, guessed.pages()[i].triangles);
        EXPECT_EQ(told.pages()[i].vertices.size(), guessed.pages()[i].vertices.size());
    }
}

TEST(Up, ACoarseCutIsOfBoundedBytes) {
    std::vector<hierarchy::PageInfo> pages(200);
    for (std::size_t i = 0; i < pages.size(); ++i) {
        pages[i].maxError = 1 + static_cast<double>(i);
        pages[i].vertexCount = 50'000;
    }
    pages.front().maxError = std::numeric_limits<double>::infinity();
    const double error = hierarchy::coarseError(std::array{std::span<const hierarchy::PageInfo>(pages)}, 4);
    std::uint64_t bytes = 0;
    for (const hierarchy::PageInfo& info : pages)
        bytes += hierarchy::isDrawnOf(info, error) ? decodedPageBytes(info) : 0;
    EXPECT_LE(bytes, (std::uint64_t{16} << 20U) + decodedPageBytes(pages.front()));
    EXPECT_TRUE(hierarchy::isDrawnOf(pages.front(), error));
    pages.resize(1);
    EXPECT_EQ(hierarchy::coarseError(std::array{std::span<const hierarchy::PageInfo>(pages)}, 4), 0.01);
}

TEST(Up, ACommentSaysIt) {
    const auto said = [](const char* comment) {
        const auto up = upOfComment(comment);
        return up ? hierarchy::upAxisText(*up) : "";
    };
    for (const auto& [comment, up] : std::vector<std::pair<const char*, const char*>>{
             {"units LDU, -Y up", "-y"},
             {"Z up", "z"},
             {"y-up, metres", "y"},
             {"Up: Z", "z"},
             {"up axis = -x", "-x"},
             {"up_axis:+y", "y"},
             {"(z up)", "z"},
             {"Z up, that is: up axis: Z", "z"},
             {"z up or y up", ""},
             {"up", ""},
             {"made up x by y", ""},
             {"oz up", ""},
             {"backup: x", ""},
             {"z upper", ""},
             {"grow up yz", ""},
             {"", ""}})
        EXPECT_EQ(said(comment), up) << comment;
}

TEST(Up, OfSourcesIsThatOfTheirHeadersWhereTheyAgree) {
    const TestFolder folder;
    const auto write = [&](const char* name, const std::string& text) {
        std::ofstream(folder.file(name), std::ios::binary) << text;
        return folder.file(name);
    };
    const std::string z = write("z.ply", "ply\nformat ascii 1.0\ncomment Z up\nend_header\ncomment x up\n");
    const std::string y = write("y.ply", "ply\r\nobj_info y up\r\nend_header\r\n");
    const std::string mute = write("mute.ply", "ply\ncommentary x up\nend_header\n");
    const std::string other = write("other.obj", "comment x up\n");
    EXPECT_EQ(upOfSources({z, mute, other}), *hierarchy::upAxisNamed("z"));
    EXPECT_EQ(upOfSources({y}), *hierarchy::upAxisNamed("y"));
    EXPECT_FALSE(upOfSources({z, y}));
    EXPECT_FALSE(upOfSources({mute, other}));
}

} // namespace
} // namespace gnomon::pipeline
