// The vertices of a cluster in vector lanes beside the parallelogram rule in plain numbers.
#include "core/random.h"
#include "hierarchy/codec/vertex_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace gnomon::hierarchy {
namespace {

constexpr std::uint32_t kFirst = 1000; // vertex of the cluster in its page
constexpr NormalCode kCode{4};

/// What a cluster of fresh vertices is stored as.
struct StoredCluster {
    StoredCluster(Random& random, std::uint32_t count) : edges(count + kMaxLanes) {
        for (std::uint32_t v = 0; v < count; ++v) {
            const auto any = [&] { return static_cast<std::uint32_t>(random.below(std::min(v + 2, 256U))); };
            edges[v] = any() | any() << 8U | any() << 16U;
            vertices.push_back(kFirst + v);
            const auto number = [&] { return static_cast<std::uint32_t>(random.below(std::uint64_t{1} << 32U)); };
            positions.push_back({{number(), number(), number(), 0}});
            normals.push_back(joinedNormal(number() & kCode.mask(), number() & kCode.mask()));
            colors.push_back(number());
        }
    }

    FreshVertices fresh() const {
        FreshVertices result;
        result.vertices = vertices;
        result.positions = positions;
        result.normals = normals;
        result.colors = colors;
        result.normalMask = joinedNormal(kCode.mask(), kCode.mask());
        result.first = kFirst;
        result.edges = std::span(edges).first(vertices.size());
        return result;
    }

    std::vector<std::uint32_t> edges;
    std::vector<std::uint32_t> vertices;
    std::vector<PositionWords> positions;
    std::vector<std::uint64_t> normals;
    std::vector<std::uint32_t> colors;
};

std::uint32_t byteOf(std::uint32_t word, unsigned byte) {
    return word >> 8U * byte & 0xFFU;
}

/// Where in `cluster` the corners are behind which `stored`'s vertex `v` lies; where one is not there yet, all are the
/// vertex before.
std::array<std::uint32_t, 3> parentsOf(const StoredCluster& stored, std::uint32_t v) {
    std::array<std::uint32_t, 3> place{};
    for (unsigned k = 0; k < 3; ++k)
        place[k] = byteOf(stored.edges[v], k) + 1;
    if (*std::max_element(place.begin(), place.end()) > v) place.fill(v);
    return place;
}

void expectPredicted(const StoredCluster& stored, const ClusterVertices& cluster, std::uint32_t v) {
    const auto [from, to, opposite] = parentsOf(stored, v);
    for (std::size_t axis = 0; axis < 3; ++axis)
        ASSERT_EQ(
            cluster.positions[v + 1].word[axis],
            stored.positions[v].word[axis] + cluster.positions[from].word[axis] + cluster.positions[to].word[axis] -
                cluster.positions[opposite].word[axis]);
    for (const unsigned half : {0U, 32U}) {
        const auto number = [half](std::uint64_t joined) { return joined >> half & 0xFFFFFFFFU; };
        const std::uint64_t mean = (number(cluster.normals[from]) + number(cluster.normals[to])) / 2;
        ASSERT_EQ(number(cluster.normals[v + 1]), (mean + number(stored.normals[v])) & kCode.mask());
    }
    for (unsigned byte = 0; byte < 4; ++byte) {
        const std::uint32_t mean = (byteOf(cluster.colors[from], byte) + byteOf(cluster.colors[to], byte)) / 2;
        ASSERT_EQ(byteOf(cluster.colors[v + 1], byte), (mean + byteOf(stored.colors[v], byte)) & 0xFFU);
    }
}

TEST(VertexKernel, PredictsByTheParallelogramAndTheMean) {
    Random random(1);
    for (int trial = 0; trial < 50; ++trial) {
        const auto count = static_cast<std::uint32_t>(1 + random.below(kMaxClusterVertices));
        const StoredCluster stored(random, count);
        const auto cluster = std::make_unique<ClusterVertices>();
        cluster->positions[0] = {{7, 8, 9, 0}};
        cluster->normals[0] = joinedNormal(1, 2);
        cluster->colors[0] = kWhite;
        predictVertices(stored.fresh(), *cluster);
        for (std::uint32_t v = 0; v < count; ++v)
            expectPredicted(stored, *cluster, v);
    }
}

TEST(VertexKernel, StoresVerticesAndTheirBox) {
    Random random(2);
    for (int trial = 0; trial < 50; ++trial) {
        const std::size_t count = 1 + random.below(kMaxClusterVertices);
        const auto cluster = std::make_unique<ClusterVertices>();
        for (std::size_t v = 0; v <= count; ++v) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                cluster->positions[v].word[axis] = static_cast<std::uint32_t>(random.below(std::uint64_t{1} << 32U));
            cluster->normals[v] = joinedNormal(
                static_cast<std::uint32_t>(random.below(4096)), static_cast<std::uint32_t>(random.below(4096)));
            cluster->colors[v] = static_cast<std::uint32_t>(random.below(1U << 30U));
        }
        std::vector<Vertex> vertices(count);
        const GridBox box = storeVertices(*cluster, kCode, vertices);
        GridBox plain{vertices[0].position, vertices[0].position};
        for (std::size_t v = 0; v < count; ++v) {
            const auto& [x, y, z, none] = cluster->positions[v + 1].word;
            ASSERT_EQ(vertices[v].position, (GridPoint{x, y, z}));
            ASSERT_EQ(vertices[v].color, cluster->colors[v + 1]);
            const auto normal = cluster->normals[v + 1];
            ASSERT_EQ(
                vertices[v].normal,
                kCode.normal(static_cast<std::uint32_t>(normal), static_cast<std::uint32_t>(normal >> 32U)));
            plain.min = {std::min(plain.min.x, x), std::min(plain.min.y, y), std::min(plain.min.z, z)};
            plain.max = {std::max(plain.max.x, x), std::max(plain.max.y, y), std::max(plain.max.z, z)};
        }
        EXPECT_EQ(box.min, plain.min);
        EXPECT_EQ(box.max, plain.max);
    }
}

} // namespace
} // namespace gnomon::hierarchy
