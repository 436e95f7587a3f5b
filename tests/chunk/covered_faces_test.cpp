// Faces of two colours in one plane: of each place the earliest face stays, whatever the faces are cut into.
#include "core/random.h"
#include "preprocess/chunk/covered_faces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace gnomon::chunk {
namespace {

constexpr std::uint32_t kGrey = 0xFF969696U;
constexpr std::uint32_t kGreen = 0xFF00FF00U;

/// Adds two triangles of one colour; the corners are in the order of a walk around the parallelogram.
void addQuad(simplify::Mesh& mesh, const std::array<glm::dvec3, 4>& corners, std::uint32_t color) {
    std::array<std::uint32_t, 4> at{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        hierarchy::Vertex vertex;
        const auto rounded = [](double x) { return static_cast<std::uint32_t>(std::llround(x)); };
        vertex.position = {rounded(corners[i].x), rounded(corners[i].y), rounded(corners[i].z)};
        vertex.color = color;
        at[i] = static_cast<std::uint32_t>(mesh.vertices.size());
        std::uint32_t position = mesh.positionCount;
        for (std::uint32_t v = 0; v < at[i]; ++v)
            if (mesh.vertices[v].position == vertex.position) position = mesh.positionOf[v];
        if (position == mesh.positionCount) {
            ++mesh.positionCount;
            mesh.isBorder.push_back(0);
        }
        mesh.vertices.push_back(vertex);
        mesh.positionOf.push_back(position);
    }
    mesh.triangles.push_back({at[0], at[1], at[2]});
    mesh.triangles.push_back({at[0], at[2], at[3]});
}

/// A rectangle in the plane z = 1000.
void addFlat(simplify::Mesh& mesh, double x0, double y0, double x1, double y1, std::uint32_t color) {
    addQuad(mesh, {{{x0, y0, 1000}, {x1, y0, 1000}, {x1, y1, 1000}, {x0, y1, 1000}}}, color);
}

double areaOf(const simplify::Mesh& mesh, std::uint32_t color) {
    double area = 0;
    for (const simplify::Triangle& t : mesh.triangles) {
        if (mesh.vertices[t[0]].color != color) continue;
        const auto at = [&](std::size_t i) {
            const hierarchy::GridPoint& p = mesh.vertices[t[i]].position;
            return glm::dvec3(p.x, p.y, p.z);
        };
        area += glm::length(glm::cross(at(1) - at(0), at(2) - at(0))) / 2;
    }
    return area;
}

/// The colours of the triangles that contain (x, y), seen along z, in the order of the triangles.
std::vector<std::uint32_t> colorsAt(const simplify::Mesh& mesh, double x, double y) {
    std::vector<std::uint32_t> colors;
    for (const simplify::Triangle& t : mesh.triangles) {
        int left = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const hierarchy::GridPoint& a = mesh.vertices[t[i]].position;
            const hierarchy::GridPoint& b = mesh.vertices[t[(i + 1) % 3]].position;
            const double turn = (double{1} * b.x - a.x) * (y - a.y) - (double{1} * b.y - a.y) * (x - a.x);
            left += turn > 0 ? 1 : -1;
        }
        if (left == 3 || left == -3) colors.push_back(mesh.vertices[t[0]].color);
    }
    return colors;
}

TEST(CoveredFaces, AStripeThatComesLaterIsGone) {
    simplify::Mesh mesh;
    addFlat(mesh, 0, 0, 10000, 6000, kGrey);
    addFlat(mesh, 1000, 2000, 9000, 2500, kGreen);
    EXPECT_EQ(removeCoveredFaces(mesh), 2U);
    EXPECT_EQ(mesh.triangles.size(), 2U);
    EXPECT_EQ(areaOf(mesh, kGreen), 0);
}

TEST(CoveredFaces, AStripeThatComesFirstIsCutOutOfTheRest) {
    simplify::Mesh mesh;
    addFlat(mesh, 1000, 2000, 9000, 2500, kGreen);
    addFlat(mesh, 0, 0, 10000, 6000, kGrey);
    EXPECT_EQ(removeCoveredFaces(mesh), 2U);
    EXPECT_DOUBLE_EQ(areaOf(mesh, kGreen), 8000.0 * 500);
    EXPECT_NEAR(areaOf(mesh, kGrey), 10000.0 * 6000 - 8000.0 * 500, 20000) << "corners are rounded to the grid";
}

TEST(CoveredFaces, OneColourLayersAndNeighboursStay) {
    simplify::Mesh mesh;
    addFlat(mesh, 0, 0, 1000, 1000, kGrey);
    addFlat(mesh, 200, 200, 800, 800, kGrey);
    addFlat(mesh, 1000, 0, 2000, 1000, kGreen);
    addQuad(mesh, {{{0, 0, 1010}, {900, 0, 1010}, {900, 900, 1010}, {0, 900, 1010}}}, kGreen);
    const std::vector<simplify::Triangle> before = mesh.triangles;
    EXPECT_EQ(removeCoveredFaces(mesh), 0U);
    EXPECT_EQ(mesh.triangles, before);
}

/// A closed box.
void addBox(simplify::Mesh& mesh, const glm::dvec3& low, const glm::dvec3& high, std::uint32_t color) {
    const auto at = [&](int x, int y, int z) {
        return glm::dvec3(x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z);
    };
    addQuad(mesh, {{at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)}}, color);
    addQuad(mesh, {{at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)}}, color);
    addQuad(mesh, {{at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)}}, color);
    addQuad(mesh, {{at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)}}, color);
    addQuad(mesh, {{at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)}}, color);
    addQuad(mesh, {{at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)}}, color);
}

TEST(CoveredFaces, SolidsInContactStay) {
    simplify::Mesh mesh;
    addBox(mesh, {0, 0, 0}, {5000, 5000, 1000}, kGrey);
    addBox(mesh, {1000, 1000, 1000}, {2000, 2000, 2000}, kGreen);
    EXPECT_EQ(removeCoveredFaces(mesh), 0U);
    EXPECT_EQ(mesh.triangles.size(), 24U);
}

TEST(CoveredFaces, ASheetThatFacesAwayCounts) {
    simplify::Mesh mesh;
    addBox(mesh, {0, 0, 0}, {5000, 5000, 1000}, kGrey);
    addQuad(mesh, {{{1000, 1000, 1000}, {1000, 2000, 1000}, {2000, 2000, 1000}, {2000, 1000, 1000}}}, kGreen);
    EXPECT_EQ(removeCoveredFaces(mesh), 2U);
    EXPECT_EQ(areaOf(mesh, kGreen), 0);
}

/// Random rectangles and parallelograms of five colours in the plane z = 1000 + `slope` x; the slow way is to ask at
/// each point which of the triangles that contain it comes first.
void expectFirstColours(double slope, std::uint64_t seed) {
    Random random(seed);
    simplify::Mesh mesh;
    for (int i = 0; i < 25; ++i) {
        const double x = random.uniform(0, 80000);
        const double y = random.uniform(30000, 80000);
        const double width = random.uniform(500, 30000);
        const double height = random.uniform(500, 30000);
        const double shear = random.uniform(-20000, 20000);
        const auto at = [&](double u, double v) { return glm::dvec3(u, v, 1000 + slope * u); };
        addQuad(
            mesh,
            {{at(x, y), at(x + width, y + shear), at(x + width, y + height + shear), at(x, y + height)}},
            0xFF000000U | 0x32U * static_cast<std::uint32_t>(random.below(5)) << 8U);
    }
    const simplify::Mesh source = mesh;
    EXPECT_GT(removeCoveredFaces(mesh), 10U);
    int wrong = 0;
    int seen = 0;
    for (int i = 0; i < 4000; ++i) {
        const double x = random.uniform(0, 110000) + 0.37;
        const double y = random.uniform(0, 130000) + 0.41;
        const std::vector<std::uint32_t> wanted = colorsAt(source, x, y);
        const std::vector<std::uint32_t> found = colorsAt(mesh, x, y);
        if (wanted.empty() && found.empty()) continue;
        ++seen;
        const auto isFirst = [&](std::uint32_t color) { return color == wanted.front(); };
        if (wanted.empty() || found.empty() || !std::ranges::all_of(found, isFirst)) ++wrong;
    }
    EXPECT_GT(seen, 500);
    EXPECT_LE(wrong, seen / 200) << "points within a few steps of an edge";
}

TEST(CoveredFaces, EachPlaceHasTheColourOfTheFirstFaceThere) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
        for (const double slope : {0.0, 0.37})
            expectFirstColours(slope, seed);
}

TEST(CoveredFaces, ManyOnOneSpotEnd) {
    simplify::Mesh mesh;
    for (std::uint32_t i = 0; i < 700; ++i)
        addFlat(mesh, i, 0, 10000 + i, 10000, 0xFF000000U | i % 250);
    removeCoveredFaces(mesh);
    EXPECT_GE(mesh.triangles.size(), 2U);
}

} // namespace
} // namespace gnomon::chunk
