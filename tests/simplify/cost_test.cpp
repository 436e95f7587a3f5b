// The estimates for many collapses at once against those for one after the other, on every kind of processor that this
// one can stand for.
#include "core/random.h"
#include "hierarchy/octahedral.h"
#include "preprocess/simplify/cost_estimate.h"
#include "preprocess/simplify/cost_kernel.h"
#include "preprocess/simplify/mesh.h"
#include "tests/support/each_processor.h"
#include "tests/support/patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace gnomon::simplify {
namespace {

constexpr std::uint32_t kCostPositions = 24;

struct Kind {
    bool hasNormals;
    bool hasColors;
    bool isFlat; // all in a row: no planes
};

glm::dvec3 randomVector(Random& random) {
    const double x = random.uniform(-1, 1);
    const double y = random.uniform(-1, 1);
    return {x, y, random.uniform(-1, 1)};
}

/// Triangles strewn among positions of one vertex each, of which some have no normal and some no triangle.
Patch randomPatch(Random& random, const Kind& kind) {
    Patch patch;
    for (std::uint32_t p = 0; p < kCostPositions; ++p) {
        patch.positions.push_back(kind.isFlat ? glm::dvec3(p, 0, 0) : randomVector(random) * 100.0);
        patch.isLocked.push_back(0);
        patch.positionOf.push_back(p);
        hierarchy::Vertex& vertex = patch.vertices.emplace_back();
        const bool isSmooth = kind.hasNormals && random.below(4) != 0;
        vertex.normal = isSmooth ? hierarchy::packNormal(randomVector(random)) : hierarchy::kNoNormal;
        vertex.color = kind.hasColors ? static_cast<std::uint32_t>(random.below(1U << 24U)) : 0;
    }
    while (patch.triangles.size() < 30) {
        const auto a = static_cast<std::uint32_t>(random.below(kCostPositions - 2));
        const auto b = static_cast<std::uint32_t>(random.below(kCostPositions - 2));
        const auto c = static_cast<std::uint32_t>(random.below(kCostPositions - 2));
        if (a != b && b != c && c != a) patch.triangles.push_back({a, b, c});
    }
    return patch;
}

void expectSame(std::uint64_t seed, const Kind& kind) {
    Random random(seed);
    const Patch patch = randomPatch(random, kind);
    CostEstimate estimate(patch, SimplificationMesh(patch));
    for (std::uint32_t from = 0; from < kCostPositions; ++from) {
        std::vector<std::uint32_t> to(random.below(20));
        for (std::uint32_t& q : to)
            q = static_cast<std::uint32_t>(random.below(kCostPositions));
        const std::span<const double> squares = estimate.squares(from, to);
        ASSERT_EQ(squares.size(), to.size());
        for (std::size_t i = 0; i < to.size(); ++i)
            EXPECT_EQ(squares[i], estimate.square(from, to[i])) << "seed " << seed << ", " << from << " to " << to[i];
    }
}

TEST(CostEstimate, GivesToTheBitForManyWhatItGivesForOneAfterTheOther) {
    proximity::onEachProcessor([] {
        for (std::uint64_t seed = 0; seed < 50; ++seed)
            for (const Kind kind :
                 {Kind{true, false, false}, {true, true, false}, {false, true, false}, {true, true, true}})
                expectSame(seed, kind);
    });
}

/// What lies across edge `i` of triangle `t`, found by a look at all triangles.
EdgeKind plainEdge(const Patch& patch, std::uint32_t t, std::size_t i) {
    const std::array<std::uint32_t, 2> ends{patch.triangles[t][i], patch.triangles[t][(i + 1) % 3]};
    EdgeKind kind = EdgeKind::Open;
    for (std::uint32_t u = 0; u < patch.triangles.size(); ++u) {
        const Triangle p = patch.corners(patch.triangles[u]);
        if (u == t || !has(p, patch.positionOf[ends[0]]) || !has(p, patch.positionOf[ends[1]])) continue;
        if (!has(patch.triangles[u], ends[0]) || !has(patch.triangles[u], ends[1])) return EdgeKind::Crease;
        kind = EdgeKind::Smooth;
    }
    return kind;
}

/// A weighted mean of squared distances of a point from planes, one after the other.
struct PlaneMean {
    glm::dvec3 point;
    double sum = 0;
    double weight = 0;

    void add(const glm::dvec3& normal, const glm::dvec3& onPlane, double planeWeight) {
        const double distance = glm::dot(glm::normalize(normal), point - onPlane);
        sum += planeWeight * distance * distance;
        weight += planeWeight;
    }
};

/// The mean of the squared distances of `to` from all planes at `from`, taken one by one: its faces by their area, and,
/// upright on them, its open edges by twice their squared length and its seams by half of it.
double plainPlanes(const Patch& patch, std::uint32_t from, std::uint32_t to) {
    PlaneMean mean{patch.positions[to]};
    for (std::uint32_t t = 0; t < patch.triangles.size(); ++t) {
        const Triangle p = patch.corners(patch.triangles[t]);
        if (!has(p, from)) continue;
        const glm::dvec3& a = patch.positions[p[0]];
        const glm::dvec3 normal = glm::cross(patch.positions[p[1]] - a, patch.positions[p[2]] - a);
        mean.add(normal, a, glm::length(normal) / 2);
        for (std::size_t i = 0; i < 3; ++i) {
            const EdgeKind kind = plainEdge(patch, t, i);
            if (kind == EdgeKind::Smooth || p[(i + 2) % 3] == from) continue;
            const glm::dvec3 edge = patch.positions[p[(i + 1) % 3]] - patch.positions[p[i]];
            const double weight = kind == EdgeKind::Open ? 2 : 0.5;
            mean.add(glm::cross(edge, normal), patch.positions[p[i]], glm::dot(edge, edge) * weight);
        }
    }
    return mean.sum / mean.weight;
}

/// A sheet whose triangles have one of two colours, by where they lie: where these meet there is a seam.
Patch sheetWithSeams() {
    const Patch plain = patchOf(read::bumpySheet(6));
    Patch patch = plain;
    patch.vertices.clear();
    patch.positionOf.clear();
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> vertexOf;
    for (std::size_t t = 0; t < plain.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t p = plain.triangles[t][i];
            const std::uint32_t color = t < 30 ? 0xFF0000FFU : 0xFF00FF00U;
            const auto next = static_cast<std::uint32_t>(patch.vertices.size());
            const auto [place, isNew] = vertexOf.emplace(std::pair(p, color), next);
            if (isNew) {
                patch.vertices.push_back(plain.vertices[p]);
                patch.vertices.back().color = color;
                patch.positionOf.push_back(p);
            }
            patch.triangles[t][i] = place->second;
        }
    return patch;
}

TEST(CostEstimate, IsTheDistanceFromThePlanesAndALittleOfTheLengthAndTheAttributes) {
    const Patch patch = sheetWithSeams();
    const SimplificationMesh mesh(patch);
    const CostEstimate estimate(patch, mesh);
    for (std::uint32_t from = 0; from < patch.positions.size(); ++from)
        for (std::uint32_t to = 0; to < patch.positions.size(); to += 5) {
            const double planes = plainPlanes(patch, from, to);
            ASSERT_NEAR(estimate.planes(from, to), planes, 1e-6 * (1 + planes)) << from << " onto " << to;
            // The first vertex of a position gives its colour.
            const auto colorOf = [&](std::uint32_t p) {
                const auto first = std::find(patch.positionOf.begin(), patch.positionOf.end(), p);
                return patch.vertices[static_cast<std::size_t>(first - patch.positionOf.begin())].color;
            };
            const glm::dvec3 way = patch.positions[to] - patch.positions[from];
            const double change = colorOf(from) == colorOf(to) ? 0 : 2; // red and green differ by one each
            const double expected = planes + glm::dot(way, way) * (1e-5 + 0.02 * change);
            ASSERT_NEAR(estimate.square(from, to), expected, 1e-6 * (1 + expected));
        }
}

TEST(CostEstimate, OfNormalsIsATenthOfTheirSquaredChange) {
    Patch patch = plainPatch({{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {10, 10, 0}}, {{0, 1, 2}, {1, 3, 2}});
    const std::array<glm::dvec3, 3> normals{glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)};
    for (std::size_t v = 0; v < normals.size(); ++v)
        patch.vertices[v].normal = hierarchy::packNormal(normals.at(v)); // the last has none
    const SimplificationMesh mesh(patch);
    const CostEstimate estimate(patch, mesh);
    EXPECT_NEAR(estimate.square(0, 1) - estimate.planes(0, 1), 100 * (1e-5 + 0.1 * 2), 0.1);
    EXPECT_NEAR(estimate.square(0, 2) - estimate.planes(0, 2), 100 * 1e-5, 1e-6);
    EXPECT_NEAR(estimate.square(1, 3) - estimate.planes(1, 3), 100 * 1e-5, 1e-6);
}

TEST(CostEstimate, WithoutAnyAreaIsAHundredthOfTheSquaredLengthAndMergedPlanesAddUp) {
    const Patch line = plainPatch({{0, 0, 0}, {1, 0, 0}, {5, 0, 0}}, {{0, 1, 2}});
    EXPECT_DOUBLE_EQ(CostEstimate(line, SimplificationMesh(line)).square(0, 2), 0.25);
    const Patch patch = patchOf(read::bumpySheet(4));
    CostEstimate estimate(patch, SimplificationMesh(patch));
    const CostEstimate before = estimate;
    estimate.merge(6, 12);
    for (std::uint32_t to = 0; to < patch.positions.size(); ++to) {
        const double low = std::min(before.planes(6, to), before.planes(12, to));
        const double high = std::max(before.planes(6, to), before.planes(12, to));
        EXPECT_GE(estimate.planes(12, to), low * (1 - 1e-9));
        EXPECT_LE(estimate.planes(12, to), high * (1 + 1e-9));
        EXPECT_EQ(estimate.planes(6, to), before.planes(6, to));
    }
}

} // namespace
} // namespace gnomon::simplify
