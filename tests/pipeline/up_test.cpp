// Which way is up: what a build guesses from shapes, what it reads of its sources, and that neither moves a triangle.
#include "core/random.h"
#include "hierarchy/coarse_cut.h"
#include "hierarchy/model_text.h"
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

/// A table of a seeded size, y up.
Shape table(Random& random) {
    Shape mesh;
    const glm::dvec3 size(random.uniform(1, 2), random.uniform(0.65, 0.8), random.uniform(0.7, 1));
    const double leg = random.uniform(0.04, 0.08);
    addBox(mesh, {0, size.y - 0.05, 0}, size);
    for (const double x : {0.0, size.x - leg})
        for (const double z : {0.0, size.z - leg})
            addBox(mesh, {x, 0, z}, {x + leg, size.y - 0.05, z + leg});
    return mesh;
}

/// Houses of seeded heights on a ground.
Shape city(Random& random) {
    Shape mesh;
    addBox(mesh, {-10, -1, -10}, {160, 0, 160}, 6);
    for (int i = 0; i < 36; ++i) {
        const glm::dvec3 low(25.0 * (i % 6), 0, 25.0 * (i / 6)); // NOLINT(bugprone-integer-division)
        const double height = random.unit() < 0.8 ? random.uniform(6, 20) : random.uniform(30, 90);
        addBox(mesh, low, low + glm::dvec3(random.uniform(10, 18), height, random.uniform(10, 18)), 2);
    }
    return mesh;
}

/// A tower of boxes, smaller the higher they lie.
Shape tower(Random& random) {
    Shape mesh;
    double low = 0;
    for (double width = 20; width > 4; width *= random.uniform(0.6, 0.8)) {
        const double high = low + random.uniform(10, 25);
        addBox(mesh, {-width / 2, low, -width / 2}, {width / 2, high, width / 2});
        low = high;
    }
    return mesh;
}

/// A height field of seeded waves.
Shape terrain(Random& random) {
    const read::CodeMesh sheet = read::bumpySheet(40, 100);
    Shape mesh{sheet.positions, sheet.triangles};
    const double a = random.uniform(0.05, 0.15);
    const double b = random.uniform(0.05, 0.15);
    for (glm::dvec3& p : mesh.positions)
        p = {p.x, 4 * (std::sin(a * p.x) + std::sin(b * p.y)), -p.y};
    return mesh;
}

/// `mesh`, which has y up, in a world where `up` is.
Shape turned(Shape mesh, const glm::dvec3& up) {
    const hierarchy::UprightFrame frame = hierarchy::uprightFrame(up);
    for (glm::dvec3& position : mesh.positions)
        position = frame.toWorld(position);
    return mesh;
}

// All axes alike: a shape is guessed the same way in whatever axis it is, and never surely wrong.
TEST(Up, IsFoundInAllSixAxes) {
    int sure = 0;
    for (const auto& make : {table, city, tower, terrain})
        for (std::uint64_t seed = 1; seed <= 2; ++seed)
            for (const char* name : kAxisNames) {
                Random random(seed);
                const BuiltModel model(turned(make(random), hierarchy::upAxisNamed(name)->direction).source());
                if (upConfidenceOf(model.summary()) != hierarchy::UpConfidence::Sure) continue;
                ++sure;
                EXPECT_EQ(hierarchy::upAxisText(model.summary().up), name) << seed << ' ' << sure;
            }
    EXPECT_GE(sure, 24) << "of 48";
}

TEST(Up, OfWhatHasNoneIsNotSure) {
    Shape box;
    addBox(box, {0, 0, 0}, {8, 5, 3}, 8);
    Shape ball;
    addBox(ball, {-1, -1, -1}, {1, 1, 1}, 8);
    for (glm::dvec3& position : ball.positions)
        position = glm::normalize(position);
    for (const Shape& mesh : {box, ball}) {
        const BuiltModel model(mesh.source());
        EXPECT_EQ(upConfidenceOf(model.summary()), hierarchy::UpConfidence::Guess);
        EXPECT_TRUE(
            hierarchy::upAxisText(model.summary().up) == "y" || hierarchy::upAxisText(model.summary().up) == "z");
    }
}

TEST(Up, ThePlaceOnTheEarthSaysIt) {
    const auto upOf = [](const glm::dvec3& at, const glm::dvec3& size) {
        return hierarchy::upOfPlace({at, at + size});
    };
    ASSERT_TRUE(upOf({512345, 5403210, 400}, {800, 300, 50}));
    EXPECT_EQ(upOf({512345, 5403210, 400}, {800, 300, 50})->up.direction, glm::dvec3(0, 0, 1)) << "UTM";
    EXPECT_EQ(upOf({512345, 400, -5403210}, {800, 50, 300})->up.direction, glm::dvec3(0, 1, 0)) << "turned to y up";
    EXPECT_EQ(upOf({2600000, 1200000, 540}, {9, 9, 9})->confidence, hierarchy::UpConfidence::Sure);
    EXPECT_FALSE(upOf({0, 0, 0}, {800, 300, 50}));
    EXPECT_FALSE(upOf({100, 200, 5}, {1, 1, 1})) << "too near to the origin";
    EXPECT_FALSE(upOf({200000, 300000, 5}, {100000, 100000, 1})) << "too wide";
    // The Eiffel tower: 48.8584 north, 2.2945 east.
    const auto globe = upOf({4200950, 168330, 4780240}, {100, 100, 100});
    ASSERT_TRUE(globe);
    const glm::dvec3 normal(0.657356, 0.026339, 0.753122);
    EXPECT_LT(glm::distance(globe->up.direction, normal), 1e-4);
    EXPECT_FALSE(upOf({4100950, 168330, 4780240}, {100, 100, 100})) << "far below the ground";
    Random random(1);
    Shape house = table(random);
    for (glm::dvec3& position : house.positions)
        position += glm::dvec3(512345, 5403210, 400);
    const BuiltModel model(house.source());
    EXPECT_EQ(hierarchy::upAxisText(model.summary().up), "z") << "whatever its shape says";
    EXPECT_EQ(upText(model.summary()), "z, sure by its coordinates, which are large on the two other axes");
}

TEST(Up, NoWordOfItMovesATriangle) {
    Random random(7);
    const Shape mesh = turned(tower(random), {0, 0, 1});
    const BuiltModel guessed(mesh.source());
    BuildOptions options;
    options.up = *hierarchy::upAxisNamed("-x");
    options.unit = hierarchy::Unit::Foot;
    options.threads = 1;
    const BuiltModel told(mesh.source(), options);
    EXPECT_EQ(hierarchy::upAxisText(told.summary().up), "-x");
    EXPECT_EQ(told.summary().unit, hierarchy::Unit::Foot);
    EXPECT_EQ(upText(told.summary()), "-x, told as asked");
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
    for (const auto& [comment, up] :
         std::vector<std::pair<const char*, const char*>>{{"units LDU, -Y up", "-y"},
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
                                                          {"chassis_zup", "z"},
                                                          {"ship_y_up", "y"},
                                                          {"zupper", ""},
                                                          {"cozup", ""},
                                                          {"", ""}})
        EXPECT_EQ(said(comment), up) << comment;
}

TEST(Up, OfSourcesIsThatOfTheirCommentsWhereTheyAgree) {
    const TestFolder folder;
    const auto write = [&](const char* name, const std::string& text) {
        std::ofstream(folder.file(name), std::ios::binary) << text;
        return folder.file(name);
    };
    const std::string z = write("z.ply", "ply\nformat ascii 1.0\ncomment Z up\nend_header\ncomment x up\n");
    const std::string y = write("y.ply", "ply\r\nobj_info y up\r\nend_header\r\n");
    const std::string mute = write("mute.ply", "ply\ncommentary x up\nend_header\n");
    const std::string obj = write("other.obj", "comment x up\nv 1 2 3\n# x up\n");
    const auto told = [](const std::vector<std::string>& paths) {
        const auto up = upOfSources(paths).told;
        return up ? hierarchy::upAxisText(*up) : "";
    };
    EXPECT_EQ(told({z, mute}), "z");
    EXPECT_EQ(told({y}), "y");
    EXPECT_EQ(told({z, y}), "");
    EXPECT_EQ(told({mute}), "");
    EXPECT_EQ(told({obj}), "x");
    EXPECT_EQ(told({write("a.off", "OFF # z up\n# -y up\n3 1 0\n")}), "-y") << "in a line of its own";
    EXPECT_EQ(told({write("a.stl", "solid part, z up\nfacet normal 0 0 1\n")}), "z");
    EXPECT_EQ(told({write("b.stl", std::string(80, ' ') + "z up")}), "") << "behind the header";
    EXPECT_EQ(told({write("part_zup.obj", "v 1 2 3\n")}), "z") << "by its name";
    EXPECT_EQ(told({write("c.glb", "z up")}), "y") << "by the format";
}

TEST(Up, ProgramsAndKindsOfFilesVote) {
    const TestFolder folder;
    const auto votes = [&](const char* name, const std::string& text) {
        std::ofstream(folder.file(name), std::ios::binary) << text;
        return upOfSources({folder.file(name)}).votes;
    };
    const auto y = [](const hierarchy::UpVotes& found) { return found[2] - found[4]; };
    EXPECT_EQ(y(votes("a.ply", "ply\nend_header\n")), 0);
    EXPECT_GT(y(votes("a.obj", "v 1 2 3\n")), 0);
    EXPECT_LT(y(votes("a.stl", "solid a\n")), 0);
    EXPECT_GT(y(votes("b.obj", "# Blender v2.79 OBJ File\n")), y(votes("a.obj", "v 1 2 3\n")));
    EXPECT_LT(y(votes("b.ply", "ply\ncomment Created by Blender 2.79\nend_header\n")), 0);
    EXPECT_LT(y(votes("c.obj", "#OBJ File exported by CloudCompare\n")), 0);
}

} // namespace
} // namespace gnomon::pipeline
