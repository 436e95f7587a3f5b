// Records of vertices, places of a chunk, triangles that are dropped and why, and work done in order by many threads.
#include "core/random.h"
#include "preprocess/chunk/chunk_streams.h"
#include "preprocess/chunk/chunk_vertices.h"
#include "preprocess/chunk/in_order.h"
#include "preprocess/chunk/survey.h"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <set>
#include <stdexcept>
#include <thread>

namespace gnomon::chunk {
namespace {

TEST(ChunkStreams, AVertexComesBackWithWhatItsFormatHas) {
    Random random(1);
    for (unsigned bits = 0; bits < 32; ++bits) {
        VertexFormat format{(bits & 1U) != 0, (bits & 2U) != 0, (bits & 4U) != 0};
        if ((bits & 8U) != 0) format.fields = hierarchy::FieldLayout::of(2);
        format.isWide = (bits & 16U) != 0;
        std::vector<ChunkVertex> vertices(20);
        std::vector<std::byte> records;
        for (ChunkVertex& vertex : vertices) {
            vertex.index = format.isWide ? random.bits() : random.below(kMaxNarrowIndex);
            vertex.position = {random.uniform(-1e6, 1e6), random.unit(), -random.unit()};
            vertex.normal = static_cast<std::uint32_t>(random.bits());
            vertex.color = static_cast<std::uint32_t>(random.bits());
            vertex.fields = static_cast<std::uint32_t>(random.bits());
            VertexBytes storage{};
            const std::span<const std::byte> record = encodeVertex(vertex, format, storage);
            ASSERT_EQ(record.size(), format.bytes());
            records.insert(records.end(), record.begin(), record.end());
        }
        std::vector<ChunkVertex> back;
        decodeVertices(records, format, back);
        ASSERT_EQ(back.size(), vertices.size());
        for (std::size_t i = 0; i < back.size(); ++i) {
            EXPECT_EQ(back[i].index, vertices[i].index);
            EXPECT_EQ(glm::vec3(back[i].position), glm::vec3(vertices[i].position));
            EXPECT_EQ(back[i].position == vertices[i].position, format.isDouble);
            EXPECT_EQ(back[i].normal, format.hasNormals ? vertices[i].normal : hierarchy::kNoNormal);
            EXPECT_EQ(back[i].color, format.hasColors ? vertices[i].color : 0xFFFFFFFFU);
            EXPECT_EQ(back[i].fields, format.hasFields() ? vertices[i].fields : 0U);
        }
    }
}

TEST(ChunkStreams, EachStreamHasANumberOfItsOwn) {
    constexpr std::uint32_t kChunks = 5;
    std::set<std::uint32_t> numbers;
    for (std::uint32_t chunk = 0; chunk < kChunks; ++chunk)
        for (const BinStream kind : {BinStream::Vertices, BinStream::Triangles, BinStream::Ghosts, BinStream::Requests})
            EXPECT_TRUE(numbers.insert(streamOf(kind, chunk)).second);
    for (const SourceStream kind : {SourceStream::Polygons, SourceStream::Triangles})
        EXPECT_TRUE(numbers.insert(streamOf(kind, kChunks)).second);
    EXPECT_EQ(numbers.size(), binStreams(kChunks));
    EXPECT_EQ(*numbers.rbegin() + 1, binStreams(kChunks)) << "without gaps";
    EXPECT_EQ(borderStreams(kChunks), 10U);
    EXPECT_EQ(streamOf(BorderStream::Normals, 4), 9U);
    PartSize size{3, 9};
    size.growTo({5, 2});
    EXPECT_EQ(size.triangles, 5U);
    EXPECT_EQ(size.vertices, 9U);
}

/// Vertices with indices from 10 on at these positions; the first `own` lie in the chunk.
ChunkVertices verticesAt(const std::vector<glm::dvec3>& positions, std::size_t own) {
    std::vector<ChunkVertex> all;
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        all.emplace_back();
        all.back().index = 10 + i;
        all.back().position = positions[i];
    }
    return {IndexedVertices(std::move(all), own), hierarchy::Grid{}};
}

TEST(ChunkVertices, ArePlacesByTheirPointOfTheGrid) {
    Random random(2);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<glm::dvec3> positions(1 + random.below(300));
        for (glm::dvec3& p : positions)
            p = {random.uniform(0, 6), random.uniform(0, 6), random.uniform(0, 3)};
        const std::size_t own = random.below(positions.size() + 1);
        const ChunkVertices vertices = verticesAt(positions, own);
        std::map<hierarchy::GridPoint, std::uint32_t> plain;
        const GridSnap snap(hierarchy::Grid{});
        for (std::uint32_t v = 0; v < positions.size(); ++v) {
            const std::uint32_t place =
                plain.emplace(snap(positions[v]), static_cast<std::uint32_t>(plain.size())).first->second;
            ASSERT_EQ(vertices.placeOf(v), place);
            ASSERT_EQ(vertices.placeOfSource(10 + v), place);
            ASSERT_EQ(vertices.places()[place], snap(positions[v]));
            if (v + 1 == own) {
                EXPECT_EQ(vertices.ownPlaces(), plain.size());
            }
        }
        EXPECT_EQ(vertices.places().size(), plain.size());
        EXPECT_EQ(vertices.size(), positions.size());
    }
}

TEST(KeptTriangles, EachReasonToDropOneIsCounted) {
    const ChunkVertices vertices =
        verticesAt({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0.2, 0, 0}, {0, 0, 0}, {4.1, 0, 0}, {0, 0, 4}}, 7);
    DroppedTriangles dropped;
    const std::vector<simplify::Triangle> kept = keptTriangles(
        vertices,
        {{0, 1, 2},  // kept
         {0, 0, 1},  // one vertex twice
         {0, 4, 1},  // two vertices at one position of the source
         {0, 3, 1},  // at one place of the grid only
         {2, 5, 3},  // the places of the first, turned
         {1, 0, 2},  // and the other way round
         {0, 1, 6}}, // kept
        dropped);
    EXPECT_EQ(kept, (std::vector<simplify::Triangle>{{0, 1, 2}, {0, 1, 6}}));
    EXPECT_EQ(dropped.degenerate, 2U);
    EXPECT_EQ(dropped.collapsedByGrid, 1U);
    EXPECT_EQ(dropped.doubled, 2U);
}

TEST(KeptTriangles, AreThoseThatASetKeeps) {
    Random random(3);
    std::vector<glm::dvec3> positions(60);
    for (glm::dvec3& p : positions)
        p = {static_cast<double>(random.below(4)), static_cast<double>(random.below(4)), 0};
    const ChunkVertices vertices = verticesAt(positions, 60);
    std::vector<simplify::Triangle> triangles(2000);
    for (simplify::Triangle& t : triangles)
        for (std::uint32_t& v : t)
            v = static_cast<std::uint32_t>(random.below(60));
    DroppedTriangles dropped;
    const std::vector<simplify::Triangle> kept = keptTriangles(vertices, triangles, dropped);
    std::set<std::set<std::uint32_t>> seen;
    std::vector<simplify::Triangle> expected;
    for (const simplify::Triangle& t : triangles) {
        const simplify::Triangle p = vertices.placesOf(t);
        const std::set<std::uint32_t> places(p.begin(), p.end());
        if (places.size() == 3 && seen.insert(places).second) expected.push_back(t);
    }
    EXPECT_EQ(kept, expected);
    EXPECT_EQ(kept.size() + dropped.degenerate + dropped.collapsedByGrid + dropped.doubled, triangles.size());
    EXPECT_EQ(dropped.collapsedByGrid, 0U) << "all lie on the grid";
}

TEST(SharedPlaces, AreThoseWhereOtherChunksMayHaveTriangles) {
    const ChunkVertices vertices = verticesAt({{0, 0, 0}, {4, 0, 0}, {0.1, 0, 0}, {9, 9, 9}}, 3);
    const std::vector<VertexRequest> forNormals{{9, 0, 10}, {9, 0, 11}};
    EXPECT_EQ(sharedPlaces(vertices, forNormals), (std::vector<std::uint8_t>{0, 0, 1})) << "the last lies elsewhere";
    const std::vector<VertexRequest> second{{7, 1, 11}, {9, 0, 10}};
    EXPECT_EQ(sharedPlaces(vertices, second), (std::vector<std::uint8_t>{0, 1, 1}));
    const std::vector<VertexRequest> samePlace{{6, 1, 12}};
    EXPECT_EQ(sharedPlaces(vertices, samePlace), (std::vector<std::uint8_t>{1, 0, 1}))
        << "a vertex at its place counts";
}

/// Raises `max` to `now` if that is more.
void raise(std::atomic<int>& max, int now) {
    int before = max;
    while (before < now && !max.compare_exchange_weak(before, now)) {
    }
}

TEST(MakeInOrder, TakesInOrderHoweverLongEachTakes) {
    std::vector<std::size_t> taken;
    std::atomic<int> held{0};
    std::atomic<int> max{0};
    const auto make = [&](std::size_t i) {
        raise(max, ++held);
        if (i % 5 == 0) std::this_thread::sleep_for(std::chrono::microseconds(300));
        return i * i;
    };
    const auto take = [&](std::size_t i, std::size_t square) {
        EXPECT_EQ(square, i * i);
        taken.push_back(i);
        --held;
    };
    makeInOrder(3, 60, 4, make, take);
    ASSERT_EQ(taken.size(), 57U);
    for (std::size_t i = 0; i < taken.size(); ++i)
        EXPECT_EQ(taken[i], i + 3);
    EXPECT_LE(max, 4) << "never more results than were asked for";
    makeInOrder(5, 5, 2, make, [](std::size_t, std::size_t) { FAIL() << "there is nothing to do"; });
}

TEST(MakeInOrder, AnErrorComesOut) {
    const auto make = [](std::size_t i) {
        if (i == 4) throw std::runtime_error("four");
        return i;
    };
    const auto take = [](std::size_t, std::size_t) {};
    EXPECT_THROW(makeInOrder(0, 10, 2, make, take), std::runtime_error);
}

} // namespace
} // namespace gnomon::chunk
