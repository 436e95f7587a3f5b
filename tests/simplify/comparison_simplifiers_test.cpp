// The simplifiers that ours is compared with: that each is given what it needs and gets its due.
#include "preprocess/simplify/hausdorff_bound.h"
#include "preprocess/simplify/simplify.h"
#include "tests/support/patches.h"

#include <gtest/gtest.h>

#include <set>

namespace gnomon::simplify {
namespace {

using hierarchy::kNone;

Patch unlocked(const read::CodeMesh& mesh) {
    Patch patch = patchOf(mesh);
    patch.isLocked.assign(patch.positions.size(), 0);
    return patch;
}

glm::dvec3 normalOf(const Patch& patch, const Triangle& triangle) {
    const Triangle p = patch.corners(triangle);
    const glm::dvec3& a = patch.positions[p[0]];
    return glm::cross(patch.positions[p[1]] - a, patch.positions[p[2]] - a);
}

TEST(ComparisonSimplifiers, ComeToTheTargetAndNotFarBelow) {
    const Patch patch = unlocked(read::bumpySheet(24));
    for (const Simplifier simplifier : {Simplifier::Meshopt, Simplifier::OpenMesh})
        for (const std::size_t target : {900U, 500U}) {
            const std::size_t found = simplify(patch, target, simplifier).triangles.size();
            EXPECT_LE(found, target);
            EXPECT_GE(found, target - 20);
        }
}

TEST(ComparisonSimplifiers, KeepEveryLockedPositionHoweverMany) {
    for (const Simplifier simplifier : {Simplifier::Meshopt, Simplifier::OpenMesh}) {
        Patch patch = unlocked(read::bumpySheet(12));
        for (std::uint32_t p = 0; p < patch.positions.size(); p += 10)
            patch.isLocked[p] = 1;
        std::set<std::uint32_t> left;
        for (const Triangle& t : simplify(patch, 1, simplifier).triangles)
            for (const std::uint32_t p : patch.corners(t))
                left.insert(p);
        for (std::uint32_t p = 0; p < patch.positions.size(); p += 10)
            EXPECT_TRUE(left.contains(p)) << p;
        EXPECT_LT(left.size(), patch.positions.size());
    }
}

TEST(ComparisonSimplifiers, MeshoptClaimsAnErrorInStepsOfTheGrid) {
    const Patch rough = unlocked(read::bumpySheet(16));
    const SimplifiedPatch simplified = simplifyMeshopt(rough, 200);
    const double measured = measureHausdorffBound(rough, simplified, 0).worst;
    EXPECT_GT(simplified.estimatedError, measured / 20);
    EXPECT_LT(simplified.estimatedError, measured * 2);
    for (std::uint32_t p = 0; p < rough.positions.size(); ++p)
        EXPECT_EQ(simplified.movedTo[p], p);
    EXPECT_EQ(simplified.origin, std::vector<std::uint32_t>(simplified.triangles.size(), kNone));
    EXPECT_TRUE(simplified.errors.empty());
}

TEST(ComparisonSimplifiers, OpenMeshSaysWhichTriangleEachWas) {
    const Patch patch = unlocked(read::bumpySheet(12));
    const SimplifiedPatch simplified = simplifyOpenMesh(patch, 150);
    ASSERT_EQ(simplified.origin.size(), simplified.triangles.size());
    std::set<std::uint32_t> origins;
    for (std::size_t t = 0; t < simplified.triangles.size(); ++t) {
        const Triangle& was = patch.triangles[simplified.origin[t]];
        EXPECT_GT(glm::dot(normalOf(patch, simplified.triangles[t]), normalOf(patch, was)), 0);
        origins.insert(simplified.origin[t]);
        int kept = 0;
        int turned = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            kept += simplified.triangles[t][i] == was[i] ? 1 : 0;
            turned += simplified.triangles[t][i] == was[(i + 1) % 3] || simplified.triangles[t][i] == was[(i + 2) % 3]
                          ? 1
                          : 0;
        }
        EXPECT_TRUE(kept > 0 || turned == 0) << "the corners of triangle " << t << " are turned";
    }
    EXPECT_EQ(origins.size(), simplified.triangles.size());
    EXPECT_EQ(simplified.movedTo.size(), patch.positions.size());
}

TEST(ComparisonSimplifiers, OpenMeshKeepsFacesThatHalfEdgesCannotHold) {
    read::CodeMesh mesh = read::bumpySheet(8);
    const auto next = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.emplace_back(0.5, 0.9, 0.5);
    mesh.triangles.push_back({40, 41, next}); // a third face on an inner edge
    mesh.triangles.push_back({41, 40, next}); // and its back
    const Patch patch = unlocked(mesh);
    const SimplifiedPatch simplified = simplifyOpenMesh(patch, 40);
    EXPECT_LT(simplified.triangles.size(), 80U);
    for (const std::uint32_t aside : {128U, 129U}) {
        const auto found = std::find(simplified.origin.begin(), simplified.origin.end(), aside);
        ASSERT_NE(found, simplified.origin.end());
        const auto place = static_cast<std::size_t>(found - simplified.origin.begin());
        EXPECT_EQ(simplified.triangles[place], patch.triangles[aside]);
    }
}

TEST(ComparisonSimplifiers, AFaceKeepsTheColourOfItsSide) {
    Patch patch = unlocked(read::bumpySheet(12));
    const auto count = static_cast<std::uint32_t>(patch.vertices.size());
    for (std::uint32_t p = 0; p < count; ++p) { // each position has a vertex of each colour
        patch.vertices[p].color = 0xFF0000FFU;
        patch.vertices.push_back(patch.vertices[p]);
        patch.vertices.back().color = 0xFFFF0000U;
        patch.positionOf.push_back(p);
    }
    for (Triangle& t : patch.triangles)
        if (t[0] % 13 >= 6)
            for (std::uint32_t& corner : t)
                corner += count;
    const SimplifiedPatch simplified = simplifyOpenMesh(patch, 100);
    for (std::size_t t = 0; t < simplified.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
            ASSERT_EQ(
                patch.vertices[simplified.triangles[t][i]].color,
                patch.vertices[patch.triangles[simplified.origin[t]][i]].color);
}

} // namespace
} // namespace gnomon::simplify
