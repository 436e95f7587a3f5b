// The normals of coarse vertices: near the source's in the mean, and what they may never touch.
#include "core/random.h"
#include "hierarchy/octahedral.h"
#include "preprocess/levels/normal_transfer.h"
#include "preprocess/levels/simplified_surface.h"
#include "preprocess/proximity/triangle_distance.h"
#include "preprocess/simplify/simplify.h"
#include "tests/support/code_mesh.h"

#include <gtest/gtest.h>

#include <limits>

namespace gnomon::levels {
namespace {

constexpr std::uint32_t kSide = 24; // squares of the sheet, along each side
constexpr double kSteps = 1000;     // grid steps of the sheet, along each side

/// A bumpy sheet with the normal that `normalAt(x, z)` gives, 0..1 both; what has x below 0.2 is locked.
template <class NormalAt>
simplify::Patch sheet(const NormalAt& normalAt) {
    const read::CodeMesh mesh = read::bumpySheet(kSide);
    simplify::Patch patch;
    for (const glm::dvec3& p : mesh.positions) {
        const glm::dvec3 steps = glm::floor((p + 1.0) * kSteps);
        hierarchy::Vertex vertex;
        vertex.position = {
            static_cast<std::uint32_t>(steps.x),
            static_cast<std::uint32_t>(steps.y),
            static_cast<std::uint32_t>(steps.z)};
        vertex.normal = hierarchy::packNormal(normalAt(p.x, p.z));
        patch.positionOf.push_back(static_cast<std::uint32_t>(patch.positions.size()));
        patch.positions.push_back(steps);
        patch.isLocked.push_back(p.x < 0.2 ? 1 : 0);
        patch.vertices.push_back(vertex);
    }
    patch.triangles = mesh.triangles;
    return patch;
}

std::vector<std::uint32_t> packedNormals(const simplify::Patch& patch) {
    std::vector<std::uint32_t> normals;
    for (const hierarchy::Vertex& vertex : patch.vertices)
        normals.push_back(vertex.normal);
    return normals;
}

std::vector<std::uint32_t> afterTransfer(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified) {
    std::vector<std::uint32_t> normals = packedNormals(patch);
    for (const TransferredNormal& transferred : transferredNormals(patch, simplified))
        normals[transferred.vertex] = transferred.normal;
    return normals;
}

/// The mean squared distance of `normals`, interpolated over the nearest simplified triangle, from those of the patch,
/// over all of its vertices: the slow way, with every triangle looked at.
double unlikeness(
    const simplify::Patch& patch,
    const simplify::SimplifiedPatch& simplified,
    const std::vector<std::uint32_t>& normals) {
    double sum = 0;
    for (std::size_t v = 0; v < patch.vertices.size(); ++v) {
        const glm::dvec3& p = patch.positions[patch.positionOf[v]];
        double best = std::numeric_limits<double>::infinity();
        glm::dvec3 found(0);
        for (const simplify::Triangle& t : simplified.triangles) {
            const simplify::Triangle c = patch.corners(t);
            const glm::dvec3& a = patch.positions[c[0]];
            const glm::dvec3 ab = patch.positions[c[1]] - a;
            const glm::dvec3 ac = patch.positions[c[2]] - a;
            const double square = proximity::distanceToTriangle(p, a, a + ab, a + ac).square;
            if (square >= best) continue;
            best = square;
            const glm::dvec3 across = glm::cross(ab, ac);
            const double area = glm::dot(across, across);
            const double v1 = glm::dot(glm::cross(p - a, ac), across) / area;
            const double v2 = glm::dot(glm::cross(ab, p - a), across) / area;
            found = hierarchy::unpackNormal(normals[t[0]]) * (1 - v1 - v2) +
                    hierarchy::unpackNormal(normals[t[1]]) * v1 + hierarchy::unpackNormal(normals[t[2]]) * v2;
        }
        const glm::dvec3 apart = hierarchy::unpackNormal(patch.vertices[v].normal) - found;
        sum += glm::dot(apart, apart);
    }
    return sum / static_cast<double>(patch.vertices.size());
}

TEST(NormalTransfer, OfARoughSurfaceComeNearerToWhatWasThere) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        Random random(seed);
        const simplify::Patch patch = sheet([&](double, double) {
            const double x = 0.3 * (2 * random.unit() - 1);
            const double y = 0.3 * (2 * random.unit() - 1);
            return glm::dvec3(x, y, 1);
        });
        const simplify::SimplifiedPatch simplified = simplify::simplifyQuadric(patch, patch.triangles.size() / 2);
        const double before = unlikeness(patch, simplified, packedNormals(patch));
        const double after = unlikeness(patch, simplified, afterTransfer(patch, simplified));
        EXPECT_LT(after, 0.8 * before) << "seed " << seed;
    }
}

TEST(NormalTransfer, OfARoundSurfaceStayAsTheyAre) {
    // They turn evenly, so that interpolation already gives what was there; a mere mean would tilt them.
    const simplify::Patch patch = sheet([](double x, double z) { return glm::dvec3(0.6 * x - 0.3, 1, 0.6 * z - 0.3); });
    const simplify::SimplifiedPatch simplified = simplify::simplifyQuadric(patch, patch.triangles.size() / 2);
    const std::vector<std::uint32_t> before = packedNormals(patch);
    const std::vector<std::uint32_t> after = afterTransfer(patch, simplified);
    for (std::size_t v = 0; v < before.size(); ++v)
        EXPECT_GT(glm::dot(hierarchy::unpackNormal(before[v]), hierarchy::unpackNormal(after[v])), 0.9999);
}

TEST(NormalTransfer, LeaveLockedVerticesCreasesAndVerticesWithoutAloneAndComeInOrder) {
    Random random(7);
    const simplify::Patch rough = sheet([&](double x, double z) {
        if (z < 0.3) return glm::dvec3(0); // none
        const double tilt = 0.2 * (2 * random.unit() - 1);
        return x < 0.6 ? glm::dvec3(tilt, 0, 1) : glm::dvec3(1, 0, tilt);
    });
    const simplify::SimplifiedPatch simplified = simplify::simplifyQuadric(rough, rough.triangles.size() / 2);
    const std::vector<TransferredNormal> transferred = transferredNormals(rough, simplified);
    ASSERT_FALSE(transferred.empty());
    for (std::size_t i = 0; i < transferred.size(); ++i) {
        const std::uint32_t v = transferred[i].vertex;
        if (i > 0) {
            EXPECT_LT(transferred[i - 1].vertex, v);
        }
        EXPECT_EQ(rough.isLocked[rough.positionOf[v]], 0);
        EXPECT_NE(rough.vertices[v].normal, hierarchy::kNoNormal);
        EXPECT_NE(transferred[i].normal, hierarchy::kNoNormal);
        const glm::dvec3 before = hierarchy::unpackNormal(rough.vertices[v].normal);
        const glm::dvec3 after = hierarchy::unpackNormal(transferred[i].normal);
        EXPECT_GT(glm::dot(before, after), 0.9) << "nothing crosses from one side of the crease to the other";
    }
}

TEST(NormalTransfer, ANeighbourWithoutANormalHindersNothing) {
    // A triangle of upright normals with a removed vertex in its middle, then one without a normal in no triangle.
    simplify::Patch patch;
    patch.positions = {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {3, 3, 0}, {1, 1, 0}};
    patch.positionOf = {0, 1, 2, 3, 4};
    patch.isLocked.assign(5, 0);
    patch.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    patch.vertices.resize(5);
    for (std::size_t v = 0; v < 3; ++v)
        patch.vertices[v].normal = hierarchy::packNormal({0, 0, 1});
    patch.vertices[3].normal = hierarchy::packNormal({0.5, 0, 1});
    patch.vertices[4].normal = hierarchy::kNoNormal;
    simplify::SimplifiedPatch simplified;
    simplified.triangles = {{0, 1, 2}};
    simplified.movedTo = {0, 1, 2, 0, 4};
    const std::vector<TransferredNormal> transferred = transferredNormals(patch, simplified);
    ASSERT_EQ(transferred.size(), 3U);
    for (const TransferredNormal& corner : transferred)
        EXPECT_GT(hierarchy::unpackNormal(corner.normal).x, 0.05) << "leans as the removed one does";
}

TEST(NormalTransfer, OfASurfaceWithoutNormalsAreNone) {
    const simplify::Patch bare = sheet([](double, double) { return glm::dvec3(0); });
    EXPECT_TRUE(transferredNormals(bare, simplify::simplifyQuadric(bare, bare.triangles.size() / 2)).empty());
}

} // namespace
} // namespace gnomon::levels
