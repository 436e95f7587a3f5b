// The vertex stage of whole clusters against one vertex at a time, on every instruction set.
#include "raster/vertex_kernel.h"
#include "tests/raster/scenes.h"
#include "tests/support/each_target.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <vector>

namespace gnomon::raster {
namespace {

constexpr PixelBox kVertexViewport = {7, 5, 330, 281};

/// Room for a cluster's snapped vertices.
struct Room {
    explicit Room(std::uint32_t count) {
        const std::size_t padded = paddedVertexCount(count);
        x.assign(padded, -7);
        y.assign(padded, -7);
        z.assign(padded, -7);
        rests.assign(padded, 7);
    }

    SnappedArrays arrays() { return {x.data(), y.data(), z.data(), rests.data()}; }

    std::vector<std::int32_t> x, y;
    std::vector<float> z;
    std::vector<std::uint32_t> rests;
};

/// What the stage must find, one vertex after another.
struct Expected {
    Expected(const Projection& pass, const Cluster& cluster) {
        std::uint32_t all = 63;
        for (std::uint32_t i = 0; i < cluster.vertexCount; ++i) {
            const ClipPosition p = clipPosition(pass, cluster.positions + std::size_t{i} * cluster.positionStride / 4);
            const std::uint32_t bits = outsideBits(pass, p);
            all &= bits;
            const bool isGuarded =
                p.w >= kMinW && std::abs(p.x) <= pass.guardX * p.w && std::abs(p.y) <= pass.guardY * p.w;
            isWhole = isWhole && isGuarded && (bits & 48U) == 0;
            vertices.push_back(isGuarded ? snapped(pass, p) : SnappedVertex{});
        }
        isOutside = all != 0;
        if (!isWhole) return;
        for (const SnappedVertex& v : vertices) {
            box.x0 = std::min(box.x0, (v.x + kSubpixels - 1) >> kSubpixelBits);
            box.y0 = std::min(box.y0, (v.y + kSubpixels - 1) >> kSubpixelBits);
            box.x1 = std::max(box.x1, (v.x >> kSubpixelBits) + 1);
            box.y1 = std::max(box.y1, (v.y >> kSubpixelBits) + 1);
        }
    }

    std::vector<SnappedVertex> vertices;
    bool isOutside = false;
    bool isWhole = true; // every vertex may be used as it is
    PixelBox box{1 << 20, 1 << 20, -(1 << 20), -(1 << 20)};
};

void compare(const Projection& pass, const Cluster& cluster, std::array<int, 3>& places, int& compact) {
    const Expected expected(pass, cluster);
    Room room(cluster.vertexCount);
    const VertexStage stage = snapVertices(pass, cluster, room.arrays());
    ++places.at(static_cast<std::size_t>(stage.place));
    EXPECT_EQ(stage.place == ClusterPlace::Outside, expected.isOutside);
    if (stage.place == ClusterPlace::Outside) return;
    EXPECT_EQ(stage.place == ClusterPlace::Inside, expected.isWhole);
    if (stage.place != ClusterPlace::Inside) {
        EXPECT_FALSE(stage.isCompact);
        return;
    }
    EXPECT_EQ(stage.box, expected.box);
    EXPECT_EQ(stage.isCompact, std::max(expected.box.width(), expected.box.height()) <= kMaxCompactPixels);
    compact += stage.isCompact ? 1 : 0;
    for (std::uint32_t i = 0; i < cluster.vertexCount; ++i) {
        const auto word = static_cast<std::uint32_t>(room.x[i]);
        const std::int32_t compactX = static_cast<std::int32_t>(word & 0xFFFFU) + (stage.box.x0 - 1) * kSubpixels;
        const std::int32_t compactY = static_cast<std::int32_t>(word >> 16U) + (stage.box.y0 - 1) * kSubpixels;
        const SnappedVertex& vertex = expected.vertices[i];
        ASSERT_EQ(stage.isCompact ? compactX : room.x[i], vertex.x) << i;
        ASSERT_EQ(stage.isCompact ? compactY : room.y[i], vertex.y) << i;
        ASSERT_EQ(std::bit_cast<std::uint32_t>(room.z[i]), std::bit_cast<std::uint32_t>(vertex.z)) << i;
        ASSERT_EQ(room.rests[i], packedRests(vertex)) << i;
    }
}

TEST(VertexKernel, IsTheVertexStageOneByOneOnEveryInstructionSet) {
    tests::onEachTarget([](const char* name) {
        SCOPED_TRACE(name);
        std::array<int, 3> places{};
        int compact = 0;
        for (std::uint64_t seed = 0; seed < 30; ++seed) {
            const View view = seed % 3 == 0 ? flatView(kVertexViewport) : insideView(kVertexViewport, seed);
            for (const bool cutsDepth : {false, true}) {
                const Projection pass = projection(view, cutsDepth);
                const Scene large = soup(200, seed);
                for (const Cluster& cluster : large.clusters())
                    compare(pass, cluster, places, compact);
                const Scene small = sheet(16, 16, 3.0 + static_cast<double>(seed), seed);
                for (const Cluster& cluster : small.clusters())
                    compare(pass, cluster, places, compact);
            }
        }
        for (const int count : places)
            EXPECT_GT(count, 10);
        EXPECT_GT(compact, 20);
    });
}

TEST(VertexKernel, DividesByNoWBelowTwoToTheMinusHundred) {
    Projection pass = projection(flatView(kVertexViewport), true);
    pass.clipFromCell = {}; // every vertex in the middle, at the same w
    const std::array<std::uint32_t, 3> position{};
    Cluster cluster;
    cluster.positions = position.data();
    cluster.vertexCount = 1;
    Room room(1);
    for (const float w : {0x1p-100F, 1.0F}) {
        pass.clipFromCell[15] = w;
        EXPECT_EQ(snapVertices(pass, cluster, room.arrays()).place, ClusterPlace::Inside) << w;
    }
    for (const float w : {std::nextafter(0x1p-100F, 0.0F), 0x1p-101F, 0.0F}) {
        pass.clipFromCell[15] = w;
        EXPECT_EQ(snapVertices(pass, cluster, room.arrays()).place, ClusterPlace::Cut) << w;
    }
}

TEST(VertexKernel, TakesClustersOfAnySizeAndStride) {
    const Scene scene = sheet(8, 8, 4, 1);
    const std::vector<Cluster> clusters = scene.clusters();
    ASSERT_EQ(clusters.size(), 1U);
    const Projection pass = projection(flatView(kVertexViewport), true);
    std::vector<std::uint32_t> wide;
    for (std::uint32_t i = 0; i < clusters[0].vertexCount; ++i) {
        wide.insert(
            wide.end(), clusters[0].positions + std::size_t{3} * i, clusters[0].positions + std::size_t{3} * i + 3);
        wide.insert(wide.end(), 2, 0xFFFFFFFFU);
    }
    std::array<int, 3> places{};
    int compact = 0;
    for (std::uint32_t count = 1; count <= clusters[0].vertexCount; ++count) {
        Cluster part = clusters[0];
        part.vertexCount = count;
        compare(pass, part, places, compact);
        part.positions = wide.data();
        part.positionStride = 20;
        compare(pass, part, places, compact);
    }
    EXPECT_EQ(compact + places[0], static_cast<int>(2 * clusters[0].vertexCount));
    EXPECT_GT(compact, 100);
    EXPECT_EQ(paddedVertexCount(0), 0U);
    EXPECT_EQ(paddedVertexCount(1), kMaxLanes);
    EXPECT_EQ(paddedVertexCount(kMaxLanes), kMaxLanes);
    EXPECT_EQ(paddedVertexCount(kMaxLanes + 1), 2 * kMaxLanes);
}

} // namespace
} // namespace gnomon::raster
