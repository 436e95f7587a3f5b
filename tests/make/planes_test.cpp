#include "core/box.h"
#include "preprocess/make/planes.h"
#include "tests/make/made_mesh.h"

#include <gtest/gtest.h>

#include <set>

namespace gnomon::make {
namespace {

/// One block by itself, its vertices counted from 0.
MadeMesh blockMesh(const MadeModel& model, std::size_t block) {
    MadeMesh all = collect(model);
    MeshSize before;
    for (std::size_t i = 0; i < block; ++i)
        before += model.blockSize(i);
    const MeshSize size = model.blockSize(block);
    MadeMesh mesh;
    for (std::uint64_t i = 0; i < size.vertices; ++i)
        mesh.vertices.push_back(all.vertices.at(before.vertices + i));
    for (std::uint64_t i = 0; i < size.triangles; ++i) {
        MadeTriangle t = all.triangles.at(before.triangles + i);
        for (std::uint64_t& corner : t)
            corner -= before.vertices;
        mesh.triangles.push_back(t);
    }
    return mesh;
}

TEST(Planes, HaveTheTrianglesAskedForWithinTwoPercent) {
    for (const std::uint64_t wanted : {20'000ULL, 33'333ULL, 275'500ULL, 1'000'000ULL, 500'000'000ULL}) {
        const auto got = static_cast<double>(modelSize(Planes(wanted, 1)).triangles);
        EXPECT_NEAR(got, static_cast<double>(wanted), 0.02 * static_cast<double>(wanted));
    }
}

TEST(Planes, AreFifteenOfEighteenThousandTrianglesOverAGround) {
    const Planes model(275'500, 1);
    ASSERT_EQ(model.blockCount(), 16U);
    Box ground;
    for (const glm::vec3& vertex : blockMesh(model, 15).vertices)
        ground.add(glm::dvec3(vertex));
    EXPECT_GE(ground.extent().x, 400);
    for (std::size_t i = 0; i < Planes::kCount; ++i) {
        EXPECT_NEAR(static_cast<double>(model.blockSize(i).triangles), 18'000, 360);
        Box plane;
        for (const glm::vec3& vertex : blockMesh(model, i).vertices)
            plane.add(glm::dvec3(vertex));
        EXPECT_GT(plane.min.y, ground.max.y);
        EXPECT_NEAR(plane.extent().x, 10.8, 0.6); // the span
        EXPECT_NEAR(plane.extent().z, 10.2, 0.6); // the length
    }
}

TEST(Planes, TheirClosedPartsFaceOutwards) {
    const MadeMesh mesh = blockMesh(Planes(100'000, 2), 3);
    std::set<std::uint64_t> borders;
    for (const auto& [edge, use] : edgeUses(mesh))
        if (use.upwards != use.downwards) borders.insert({edge.first, edge.second});
    // Parts follow one another, and each refers to its own vertices only.
    double volume = 0;
    bool closed = true;
    std::uint64_t last = 0;
    int closedParts = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const MadeTriangle& t = mesh.triangles[i];
        volume += glm::dot(
            glm::dvec3(mesh.vertices[t[0]]),
            glm::cross(glm::dvec3(mesh.vertices[t[1]]), glm::dvec3(mesh.vertices[t[2]])));
        for (const std::uint64_t corner : t) {
            last = std::max(last, corner);
            closed = closed && !borders.contains(corner);
        }
        const bool partEnds =
            i + 1 == mesh.triangles.size() ||
            std::min({mesh.triangles[i + 1][0], mesh.triangles[i + 1][1], mesh.triangles[i + 1][2]}) > last;
        if (!partEnds) continue;
        if (closed) {
            EXPECT_GT(volume, 0) << "the part that ends with triangle " << i;
        }
        closedParts += closed ? 1 : 0;
        volume = 0;
        closed = true;
    }
    EXPECT_GE(closedParts, 13);
}

} // namespace
} // namespace gnomon::make
