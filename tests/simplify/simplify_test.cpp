// The simplifier by itself: what it may never do.
#include "core/random.h"
#include "preprocess/simplify/cost_estimate.h"
#include "preprocess/simplify/hausdorff_bound.h"
#include "preprocess/simplify/locked_edge_check.h"
#include "preprocess/simplify/simplify.h"
#include "tests/support/patches.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::simplify {
namespace {

/// Every point strewn on the patch has a triangle of the simplified patch that carries its error, and the other way
/// round.
void expectHonest(const Patch& patch, const std::vector<Triangle>& simplified, std::span<const TriangleError> errors) {
    ASSERT_EQ(simplified.size(), errors.size());
    Random random(23);
    for (std::size_t t = 0; t < patch.triangles.size(); ++t)
        for (int sample = 0; sample < 3; ++sample) {
            const glm::dvec3 p = randomPoint(patch, patch.triangles[t], random);
            const double before = patch.error(t).fromSource;
            bool isHeld = false;
            for (std::size_t s = 0; s < simplified.size() && !isHeld; ++s)
                isHeld =
                    distanceTo(patch, p, simplified[s]) + before <= double{errors[s].fromSource} * (1 + 1e-9) + 1e-9;
            ASSERT_TRUE(isHeld) << "triangle " << t << " of the patch";
        }
    for (std::size_t s = 0; s < simplified.size(); ++s)
        for (int sample = 0; sample < 6; ++sample) {
            const glm::dvec3 p = randomPoint(patch, simplified[s], random);
            bool isHeld = false;
            for (std::size_t t = 0; t < patch.triangles.size() && !isHeld; ++t)
                isHeld = distanceTo(patch, p, patch.triangles[t]) + double{patch.error(t).toSource} <=
                         double{errors[s].toSource} * (1 + 1e-9) + 1e-9;
            ASSERT_TRUE(isHeld) << "simplified triangle " << s;
        }
}

std::vector<TriangleError> someErrors(std::size_t count) {
    Random random(29);
    std::vector<TriangleError> errors(count);
    for (TriangleError& error : errors) {
        error.fromSource = static_cast<float>(random.below(3) == 0 ? random.uniform(0, 20) : 0);
        error.toSource = static_cast<float>(random.below(3) == 0 ? random.uniform(0, 20) : 0);
    }
    return errors;
}

TEST(Simplify, TheErrorsOfItsTrianglesHoldForEveryPointOfBothSurfaces) {
    std::vector<Patch> patches{patchOf(read::bumpySheet(20)), patchOf(read::strewnBoxes(60)), patchOf(mixedMesh())};
    for (Patch& patch : patches)
        for (const std::size_t share : {2U, 5U, 40U}) {
            const std::vector<TriangleError> errors = someErrors(patch.triangles.size());
            patch.errors = errors;
            const SimplifiedPatch simplified = simplifyQuadric(patch, patch.triangles.size() / share);
            EXPECT_LT(simplified.triangles.size(), patch.triangles.size() * 3 / 4);
            expectHonest(patch, simplified.triangles, simplified.errors);
        }
}

TEST(Simplify, WhatTheSimplifierBoundsIsNearToWhatIsMeasuredAfterwards) {
    const Patch patch = patchOf(read::bumpySheet(30));
    const SimplifiedPatch simplified = simplifyQuadric(patch, patch.triangles.size() / 2);
    const HausdorffBound measured = measureHausdorffBound(patch, simplified, 0);
    expectHonest(patch, simplified.triangles, measured.errors);
    double bounded = 0;
    for (const TriangleError& error : simplified.errors)
        bounded = std::max({bounded, double{error.fromSource}, double{error.toSource}});
    EXPECT_LE(bounded, 3 * measured.worst);
}

TEST(Simplify, WhatIsMeasuredAfterwardsUpToAGoalHoldsForEveryPointOfBothSurfaces) {
    std::vector<Patch> patches{patchOf(read::bumpySheet(20)), patchOf(read::strewnBoxes(60)), patchOf(mixedMesh())};
    for (Patch& patch : patches) {
        const std::vector<TriangleError> errors = someErrors(patch.triangles.size());
        patch.errors = errors;
        const SimplifiedPatch simplified = simplifyQuadric(patch, patch.triangles.size() / 3);
        for (const double goal : {10.0, 30.0, 200.0}) {
            const HausdorffBound measured = measureHausdorffBound(patch, simplified, goal);
            expectHonest(patch, simplified.triangles, measured.errors);
            for (std::size_t t = 0; t < simplified.triangles.size(); ++t) {
                if (simplified.errors[t].toSource > goal) continue;
                ASSERT_LE(measured.errors[t].toSource, simplified.errors[t].toSource) << "kept, or the same triangle";
            }
        }
    }
}

TEST(Simplify, TheOthersToBeComparedWithKeepWhatOtherGroupsCountOnAndAreMeasuredHonestly) {
    for (const Simplifier simplifier : {Simplifier::Meshopt, Simplifier::OpenMesh}) {
        std::vector<Patch> patches{patchOf(read::bumpySheet(20)), patchOf(read::strewnBoxes(60)), patchOf(mixedMesh())};
        for (Patch& patch : patches) {
            const std::vector<TriangleError> errors = someErrors(patch.triangles.size());
            patch.errors = errors;
            const SimplifiedPatch simplified = simplify(patch, patch.triangles.size() / 2, simplifier);
            EXPECT_TRUE(keepsLockedEdges(patch, simplified.triangles));
            EXPECT_TRUE(simplified.errors.empty());
            expectHonest(patch, simplified.triangles, measureHausdorffBound(patch, simplified, 1).errors);
        }
        const Patch sheet = patchOf(read::bumpySheet(20));
        EXPECT_LT(simplify(sheet, 400, simplifier).triangles.size(), 480U);
    }
}

TEST(Simplify, ALongThinStripDoesNotShrinkBeforeWhatIsRoughAsLongAsItIsWide) {
    // Quadrics average: for them the end of a strip is as near as the strip is wide.
    read::CodeMesh mesh = read::bumpySheet(10, 0.1);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::dvec3& p :
         {glm::dvec3(-0.9, 0, 0.5), glm::dvec3(0.9, 0, 0.5), glm::dvec3(0.9, 0, 0.51), glm::dvec3(-0.9, 0, 0.51)})
        mesh.positions.push_back(p);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
    Patch patch = patchOf(mesh);
    patch.isLocked.assign(patch.isLocked.size(), 0);
    const SimplifiedPatch simplified = simplifyQuadric(patch, patch.triangles.size() / 2);
    for (const TriangleError& error : simplified.errors)
        EXPECT_LT(error.fromSource, 100);
}

TEST(Simplify, TrianglesThatShareNothingButAnEdgeCollapseOntoAVertexThatLosesItsLastFace) {
    // Each part is two faces on one edge, with corners of their own: both vanish, and nothing is left around the
    // target.
    read::CodeMesh pairs({}, {});
    Random random(37);
    for (int pair = 0; pair < 40; ++pair) {
        const auto first = static_cast<std::uint32_t>(pairs.positions.size());
        const double x = random.unit();
        for (const glm::dvec3& corner :
             {glm::dvec3(0), glm::dvec3(0.004, 0, 0), glm::dvec3(0.002, 0.3, 0), glm::dvec3(0.002, -0.3, 0.1)})
            pairs.positions.push_back(corner + glm::dvec3(x, 0.5, pair * 0.02));
        pairs.triangles.push_back({first, first + 1, first + 2});
        pairs.triangles.push_back({first, first + 1, first + 3});
    }
    Patch patch = patchOf(pairs);
    const SimplifiedPatch simplified = simplifyQuadric(patch, 8);
    EXPECT_GE(simplified.triangles.size(), 1U);
    expectHonest(patch, simplified.triangles, simplified.errors);
}

/// A pyramid of height `h` on a locked triangle, and far from it a locked strip of many small triangles.
Patch pyramidBesideStrip(double h) {
    std::vector<glm::dvec3> positions{{0, 0, h}};
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < 3; ++i) {
        const double angle = i * 2 * std::acos(0.5);
        positions.emplace_back(10 * std::cos(angle), 10 * std::sin(angle), 0);
        triangles.push_back({0, 1 + i, 1 + (i + 1) % 3});
    }
    for (std::uint32_t i = 0; i < 100; ++i) {
        positions.emplace_back(1000 + i, i % 2, 0);
        if (i >= 2) triangles.push_back({2 + i, 3 + i, 4 + i});
    }
    Patch patch = plainPatch(std::move(positions), std::move(triangles));
    patch.isLocked.assign(patch.positions.size(), 1);
    patch.isLocked[0] = 0;
    return patch;
}

TEST(Simplify, ACollapseCostsAtMostTwoAndAHalfMeanEdgesWhereThereIsALimit) {
    int refused = 0;
    int allowed = 0;
    for (double h = 1; h < 12; h += 0.1) {
        Patch patch = pyramidBesideStrip(h);
        double sum = 0;
        for (const Triangle& t : patch.triangles)
            for (std::size_t i = 0; i < 3; ++i)
                sum += glm::distance(patch.positions[t[i]], patch.positions[t[(i + 1) % 3]]);
        const double limit = 2.5 * sum / (3.0 * static_cast<double>(patch.triangles.size()));
        // What the apex moves, or what the planes of its faces say of that, whichever is more.
        const double cost = std::max(h, std::sqrt(CostEstimate(patch, SimplificationMesh(patch)).square(0, 1)));
        if (std::abs(cost - limit) < 0.001 * limit) continue;
        EXPECT_EQ(simplifyQuadric(patch, 1).triangles.size(), patch.triangles.size() - 2) << "no limit";
        patch.costLimit = CostLimit::MeanEdge;
        const bool isCollapsed = simplifyQuadric(patch, 1).triangles.size() < patch.triangles.size();
        EXPECT_EQ(isCollapsed, cost < limit) << "cost " << cost << ", limit " << limit;
        ++(isCollapsed ? allowed : refused);
    }
    EXPECT_GT(allowed, 10);
    EXPECT_GT(refused, 10);
}

TEST(Simplify, AnEarOnALockedEdgeStaysHoweverFewTrianglesAreWanted) {
    // Two triangles, each hanging with one free corner on an edge that the group on its other side counts on.
    Patch patch;
    for (const double x : {0.0, 10.0}) {
        const auto first = static_cast<std::uint32_t>(patch.positions.size());
        for (const glm::dvec3 p : {glm::dvec3(x, 0, 0), glm::dvec3(x + 4, 0, 0), glm::dvec3(x + 2, 3, 0)}) {
            hierarchy::Vertex vertex;
            vertex.position = {
                static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y), static_cast<std::uint32_t>(p.z)};
            patch.vertices.push_back(vertex);
            patch.positionOf.push_back(static_cast<std::uint32_t>(patch.positions.size()));
            patch.positions.push_back(p);
            patch.isLocked.push_back(p.y == 0 ? 1 : 0);
        }
        patch.triangles.push_back({first, first + 1, first + 2});
    }
    EXPECT_EQ(simplifyQuadric(patch, 1).triangles.size(), 2U);
}

TEST(Simplify, LockedPositionsStayWhereverTheyLie) {
    Random random(37);
    for (const std::uint64_t oneIn : {2U, 5U, 20U}) {
        Patch patch = patchOf(read::bumpySheet(16));
        for (std::uint8_t& isLocked : patch.isLocked)
            isLocked = random.below(oneIn) == 0 ? 1 : 0;
        const SimplifiedPatch simplified = simplifyQuadric(patch, 1);
        EXPECT_LT(simplified.triangles.size(), patch.triangles.size());
        std::vector<std::uint8_t> isThere(patch.positions.size(), 0);
        for (const Triangle& t : simplified.triangles)
            for (const std::uint32_t p : patch.corners(t))
                isThere[p] = 1;
        for (std::uint32_t p = 0; p < patch.positions.size(); ++p)
            if (patch.isLocked[p] != 0) {
                EXPECT_EQ(simplified.movedTo[p], p);
                EXPECT_EQ(isThere[p], 1) << p;
            }
    }
}

} // namespace
} // namespace gnomon::simplify
