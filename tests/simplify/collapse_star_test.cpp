// The tests that forbid a collapse against the mesh as it would be, and what a collapse does to seams.
#include "preprocess/simplify/collapse_star.h"
#include "tests/support/patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace gnomon::simplify {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// A torus of `rings` x `around` squares; with three around or three rings it has circles of three edges that bound no
/// triangle.
Patch torus(std::uint32_t rings, std::uint32_t around) {
    std::vector<glm::dvec3> positions;
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < rings; ++i)
        for (std::uint32_t k = 0; k < around; ++k) {
            const double u = 2 * std::numbers::pi * i / rings;
            const double v = 2 * std::numbers::pi * k / around;
            const double r = 30 + 10 * std::cos(v);
            positions.emplace_back(r * std::cos(u), r * std::sin(u), 10 * std::sin(v));
            const std::uint32_t a = i * around + k;
            const std::uint32_t b = i * around + (k + 1) % around;
            const std::uint32_t c = (i + 1) % rings * around + k;
            const std::uint32_t d = (i + 1) % rings * around + (k + 1) % around;
            triangles.push_back({a, c, d});
            triangles.push_back({a, d, b});
        }
    return plainPatch(std::move(positions), std::move(triangles));
}

/// What `triangles` are after `from` moved onto `to`.
std::vector<Triangle> collapsed(std::vector<Triangle> triangles, std::uint32_t from, std::uint32_t to) {
    std::erase_if(triangles, [&](const Triangle& t) {
        return std::find(t.begin(), t.end(), from) != t.end() && std::find(t.begin(), t.end(), to) != t.end();
    });
    for (Triangle& t : triangles)
        std::replace(t.begin(), t.end(), from, to);
    return triangles;
}

std::map<Edge, int> facesAtEdges(const std::vector<Triangle>& triangles) {
    std::map<Edge, int> faces;
    for (const Triangle& t : triangles)
        for (std::size_t i = 0; i < 3; ++i)
            ++faces[std::minmax(t[i], t[(i + 1) % 3])];
    return faces;
}

/// Vertices minus edges plus faces; and whether each edge has two faces.
struct Topology {
    std::ptrdiff_t euler = 0;
    bool isClosed = true;
    bool operator==(const Topology&) const = default;
};

Topology topologyOf(const std::vector<Triangle>& triangles) {
    const std::map<Edge, int> faces = facesAtEdges(triangles);
    std::set<std::uint32_t> vertices;
    for (const Triangle& t : triangles)
        vertices.insert(t.begin(), t.end());
    Topology topology;
    topology.euler = static_cast<std::ptrdiff_t>(vertices.size()) - static_cast<std::ptrdiff_t>(faces.size()) +
                     static_cast<std::ptrdiff_t>(triangles.size());
    for (const auto& [edge, count] : faces)
        topology.isClosed = topology.isClosed && count == 2;
    return topology;
}

TEST(CollapseStar, OnAClosedSurfaceTheLinkConditionHoldsWhereTheTopologyStays) {
    int violations = 0;
    int edges = 0;
    for (const Patch& patch : {torus(3, 7), torus(5, 4), torus(8, 3), torus(3, 3)}) {
        SimplificationMesh mesh(patch);
        CollapseStar star(patch, mesh);
        const Topology before = topologyOf(patch.triangles);
        ASSERT_EQ(before, (Topology{0, true}));
        for (const auto& [edge, count] : facesAtEdges(patch.triangles))
            for (const auto& [from, to] : {edge, Edge{edge.second, edge.first}}) {
                star.gather(from, to);
                const bool changes = topologyOf(collapsed(patch.triangles, from, to)) != before;
                ASSERT_EQ(star.violatesLinkCondition(), changes) << from << " onto " << to;
                violations += changes ? 1 : 0;
                ++edges;
            }
    }
    EXPECT_GT(violations, 50);
    EXPECT_LT(violations, edges - 50);
}

TEST(CollapseStar, TheLinkConditionHoldsAlongABorderAndNotAcrossOrWithoutAnEdge) {
    const Patch patch = patchOf(read::bumpySheet(4)); // 5 x 5 positions, those of x = 0 locked
    SimplificationMesh mesh(patch);
    CollapseStar star(patch, mesh);
    const auto violates = [&](std::uint32_t from, std::uint32_t to) {
        star.gather(from, to);
        return star.violatesLinkCondition();
    };
    EXPECT_FALSE(violates(2, 3));   // along the border
    EXPECT_FALSE(violates(2, 7));   // from the border inwards
    EXPECT_FALSE(violates(12, 13)); // inside
    EXPECT_TRUE(violates(19, 23));  // an edge across a corner of the sheet
    EXPECT_TRUE(violates(12, 24));  // no edge
}

TEST(CollapseStar, AFaceTurnsByMoreThan75DegreesOrOverFromItsFirstNormal) {
    Random random(9);
    int turned = 0;
    for (int run = 0; run < 3000; ++run) {
        std::vector<glm::dvec3> positions;
        for (int i = 0; i < 4; ++i) {
            const double x = random.uniform(-1, 1);
            const double y = random.uniform(-1, 1);
            positions.emplace_back(x, y, random.uniform(-1, 1));
        }
        const Patch patch = plainPatch(positions, {{0, 2, 3}, {0, 1, 2}});
        SimplificationMesh mesh(patch);
        CollapseStar star(patch, mesh);
        star.gather(0, 1);
        const auto normalFrom = [&](std::size_t apex) {
            return glm::cross(positions[2] - positions[apex], positions[3] - positions[apex]);
        };
        const glm::dvec3 before = normalFrom(0);
        const glm::dvec3 after = normalFrom(1);
        const double cosine = glm::dot(before, after) / (glm::length(before) * glm::length(after));
        if (std::abs(cosine - 0.25) < 1e-9) continue;
        ASSERT_EQ(star.turnsFace(), cosine < 0.25) << cosine;
        turned += cosine < 0.25 ? 1 : 0;
    }
    EXPECT_GT(turned, 300);
    // In steps of 60 degrees a face would be over after two.
    const Patch steps = plainPatch(
        {{0, 1, 0}, {0, 0.5, 0.866}, {0, -0.5, 0.866}, {-1, 0, 0}, {1, 0, 0}}, {{0, 3, 4}, {0, 1, 3}, {1, 2, 3}});
    SimplificationMesh mesh(steps);
    CollapseStar star(steps, mesh);
    star.gather(0, 1);
    ASSERT_FALSE(star.turnsFace());
    star.apply();
    mesh.merge(0, 1);
    star.gather(1, 2);
    EXPECT_TRUE(star.turnsFace());
}

TEST(CollapseStar, ALockedEdgeBreaksWhereItGainsOrLosesAFace) {
    Random random(4);
    int broken = 0;
    for (int run = 0; run < 60; ++run) {
        Patch patch = run % 2 == 0 ? torus(4, 5) : patchOf(read::bumpySheet(4));
        for (std::uint8_t& isLocked : patch.isLocked)
            isLocked = random.below(3) == 0 ? 1 : 0;
        SimplificationMesh mesh(patch);
        CollapseStar star(patch, mesh);
        const auto lockedFaces = [&](const std::vector<Triangle>& triangles) {
            std::map<Edge, int> faces = facesAtEdges(triangles);
            std::erase_if(faces, [&](const auto& entry) {
                return patch.isLocked[entry.first.first] == 0 || patch.isLocked[entry.first.second] == 0;
            });
            return faces;
        };
        for (const auto& [edge, count] : facesAtEdges(patch.triangles)) {
            if (patch.isLocked[edge.first] != 0) continue;
            star.gather(edge.first, edge.second);
            const bool expected =
                lockedFaces(collapsed(patch.triangles, edge.first, edge.second)) != lockedFaces(patch.triangles);
            ASSERT_EQ(star.breaksLockedEdge(), expected);
            broken += expected ? 1 : 0;
        }
    }
    EXPECT_GT(broken, 100);
}

TEST(CollapseStar, IsOrderedAsAFanFromTheTargetOn) {
    for (const Patch& patch : {torus(5, 6), patchOf(read::bumpySheet(5))}) {
        SimplificationMesh mesh(patch);
        CollapseStar star(patch, mesh);
        for (const auto& [edge, count] : facesAtEdges(patch.triangles)) {
            star.gather(edge.first, edge.second);
            Fan fan;
            const bool isFan = star.orderAsFan(fan);
            // Inside, and along a border; not from a border inwards, where the target is no end of the rim.
            const bool isOnBorder = mesh.isBorder(edge.first) || patch.isLocked[edge.first] != 0;
            ASSERT_TRUE(isFan || isOnBorder);
            if (!isFan) continue;
            ASSERT_EQ(fan.isClosed, star.vanishingCount() == 2);
            ASSERT_EQ(fan.count, star.faces().size() + (fan.isClosed ? 0 : 1));
            ASSERT_EQ(fan.apex, patch.positions[edge.first]);
            ASSERT_EQ(fan.rim[0], patch.positions[edge.second]);
            for (std::size_t i = 0; i < star.faces().size(); ++i) {
                const StarFace& face = star.faces()[i];
                const std::set<std::uint32_t> corners{face.b, face.c};
                for (const std::uint32_t corner : corners)
                    ASSERT_TRUE(
                        fan.rim.at(i) == patch.positions[corner] ||
                        fan.rim.at((i + 1) % fan.count) == patch.positions[corner]);
            }
        }
    }
}

/// A sheet of n x n squares whose columns left of x = n / 2 are of one colour and right of it of another: positions on
/// that line have a vertex of each.
Patch sheetWithSeam(std::uint32_t n) {
    Patch patch;
    const Patch plain = patchOf(read::bumpySheet(n));
    patch.positions = plain.positions;
    patch.isLocked.assign(plain.positions.size(), 0);
    const auto vertexAt = [&](std::uint32_t p, std::uint32_t color) {
        for (std::uint32_t v = 0; v < patch.vertices.size(); ++v)
            if (patch.positionOf[v] == p && patch.vertices[v].color == color) return v;
        patch.vertices.emplace_back().color = color;
        patch.positionOf.push_back(p);
        return static_cast<std::uint32_t>(patch.vertices.size() - 1);
    };
    for (const Triangle& t : plain.triangles) {
        std::uint32_t columns = 0;
        for (const std::uint32_t p : t)
            columns += p % (n + 1);
        const std::uint32_t color = 2 * columns < 3 * n ? 0xFF0000FFU : 0xFFFF0000U;
        patch.triangles.push_back({vertexAt(t[0], color), vertexAt(t[1], color), vertexAt(t[2], color)});
    }
    return patch;
}

TEST(CollapseStar, AFaceKeepsItsSideOfASeam) {
    const std::uint32_t n = 6;
    const Patch patch = sheetWithSeam(n);
    for (std::uint32_t row = 1; row + 1 < n; ++row) {
        SimplificationMesh mesh(patch);
        CollapseStar star(patch, mesh);
        const std::uint32_t from = row * (n + 1) + n / 2;
        star.gather(from, from + n + 1); // along the seam
        star.apply();
        for (std::uint32_t t = 0; t < patch.triangles.size(); ++t) {
            if (mesh.isRemoved(t)) continue;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t v = mesh.vertices(t)[i];
                ASSERT_EQ(patch.vertices[v].color, patch.vertices[patch.triangles[t][i]].color);
                ASSERT_EQ(patch.positionOf[v], mesh.positions(t)[i]);
                ASSERT_NE(mesh.positions(t)[i], from);
            }
        }
    }
}

TEST(CollapseStar, AVertexIsReplacedByTheOneOfTheNearestColourInEachChannel) {
    for (const std::uint32_t shift : {0U, 8U, 16U, 24U}) {
        // Position 0 moves onto 1. Each has two vertices; the face that vanishes has the first of both.
        Patch patch = plainPatch({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {2, 1, 0}}, {});
        patch.positionOf = {0, 0, 1, 1, 2, 3, 4};
        patch.triangles = {{0, 2, 4}, {1, 4, 5}, {3, 6, 4}};
        patch.vertices.assign(patch.positionOf.size(), {});
        for (Vertex& vertex : patch.vertices)
            vertex.color = 0x80808080U;
        for (const std::uint32_t v : {1U, 3U})
            patch.vertices[v].color += 1U << shift;
        SimplificationMesh mesh(patch);
        CollapseStar star(patch, mesh);
        star.gather(0, 1);
        star.apply();
        EXPECT_TRUE(mesh.isRemoved(0));
        EXPECT_EQ(mesh.vertices(1)[0], 3U) << "bits from " << shift << " on";
    }
}

} // namespace
} // namespace gnomon::simplify
