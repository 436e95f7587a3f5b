// More chunks than 16 bits number, and vertices that need more than 32.
#include "core/random.h"
#include "preprocess/chunk/binning.h"
#include "preprocess/chunk/chunk_writer.h"
#include "preprocess/chunk/vertex_table.h"
#include "tests/support/code_mesh.h"

#include <gtest/gtest.h>

#include <map>

namespace gnomon::chunk {
namespace {

/// `count` triangles with vertices of their own, each so far from the others that a chunk of one takes it.
read::CodeMesh lonelyTriangles(std::uint32_t count) {
    std::vector<glm::dvec3> positions;
    std::vector<read::CodeMesh::Triangle> triangles;
    for (std::uint32_t t = 0; t < count; ++t) {
        const glm::dvec3 place(t % 300, t / 300, 0);
        for (const glm::dvec3 corner : {glm::dvec3(0), glm::dvec3(0.5, 0, 0), glm::dvec3(0, 0.5, 0)})
            positions.push_back(place + corner);
        triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return {std::move(positions), std::move(triangles)};
}

TEST(SlowManyChunks, EachHasTheTrianglesAndVerticesThatLieThere) {
    read::CodeMesh mesh = lonelyTriangles(70'000);
    NoProgress progress;
    SourceSurvey survey = surveySource(mesh, progress);
    const ChunkTree tree = planChunks(mesh, survey, 1, progress);
    ASSERT_GT(tree.chunkCount(), 66'000U);
    scratch::TemporarySpace space(progress);
    const auto file = scratch::scratchInMemory(space);
    scratch::StreamStore bins(*file, binStreams(tree.chunkCount()), 128);
    EXPECT_LE(binSource(mesh, survey, tree, bins, 10, progress).largestChunk.triangles, 3U);
    const VertexFormat format = formatOf(mesh.summary());
    const GridSnap snap(survey.grid);
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    for (std::uint32_t chunk = 0; chunk < tree.chunkCount(); ++chunk) {
        forEachTriangle(bins, streamOf(BinStream::Triangles, chunk), format, [&](const read::TriangleCorners& t) {
            std::array<std::uint32_t, 3> lies{};
            for (std::size_t i = 0; i < 3; ++i)
                lies[i] = tree.chunkOf(snap(mesh.positions[t[i]]));
            std::sort(lies.begin(), lies.end());
            ASSERT_EQ(chunk, lies[1]);
            ++triangles;
        });
        std::vector<ChunkVertex> own;
        appendVertices(bins, streamOf(BinStream::Vertices, chunk), format, own);
        for (const ChunkVertex& vertex : own)
            ASSERT_EQ(tree.chunkOf(snap(mesh.positions[vertex.index])), chunk);
        vertices += own.size();
    }
    EXPECT_EQ(triangles, 70'000U);
    EXPECT_EQ(vertices, 210'000U);
}

TEST(VertexTable, IsAMapFromNumbersOfAnySize) {
    Random random(1);
    for (const std::uint64_t largest : {0xFFFFULL, 0x10000ULL, 0xFFFFFFFFULL}) {
        constexpr std::uint64_t kVertices = 5'000'000'000;
        VertexNumbers numbers(kVertices, largest);
        VertexTable<std::uint8_t> counts(kVertices);
        std::map<std::uint64_t, std::uint32_t> plain;
        for (int i = 0; i < 300; ++i) {
            const std::uint64_t vertex = i % 2 == 0 ? random.below(kVertices) : kVertices - 1 - random.below(70'000);
            plain[vertex] = static_cast<std::uint32_t>(random.below(largest + 1));
            numbers.set(vertex, plain[vertex]);
            counts.at(vertex) = static_cast<std::uint8_t>(plain[vertex]);
        }
        for (const auto& [vertex, number] : plain) {
            EXPECT_EQ(numbers[vertex], number);
            EXPECT_EQ(counts[vertex], number % 256);
            if (!plain.contains(vertex ^ 1U) && (vertex ^ 1U) < kVertices) {
                EXPECT_EQ(numbers[vertex ^ 1U], 0U);
            }
        }
    }
}

TEST(ChunkStreams, NumbersComeBackInFourBytesAndInEight) {
    NoProgress progress;
    for (const bool isWide : {false, true}) {
        VertexFormat format;
        format.isWide = isWide;
        const std::uint64_t large = isWide ? 0x123456789AULL : 0xFFFFFFFE;
        scratch::TemporarySpace space(progress);
        const auto file = scratch::scratchInMemory(space);
        scratch::StreamStore store(*file, 3, 64);
        const std::vector<read::TriangleCorners> triangles{
            {1, large, 3}, {kPolygonMark, 2, 0}, {large - 1, 0, large}, {2, 3, large}};
        for (const read::TriangleCorners& t : triangles)
            putTriangle(store, 0, t, format);
        std::vector<VertexRequest> requests{{7, 1, large}, {7, 0, large}, {7, 1, 2}, {6, 1, large}};
        for (const VertexRequest& request : requests)
            putRequest(store, 1, request, format);
        std::vector<std::byte> normals;
        appendNormal(normals, {large, 77}, format);
        appendNormal(normals, {4, 0xFFFFFFFF}, format);
        store.append(2, normals);
        store.flush();
        EXPECT_EQ(triangleRecords(store, 0, format), triangles.size());
        EXPECT_EQ(store.bytes(0), triangles.size() * (isWide ? 24U : 12U));
        std::vector<read::TriangleCorners> back;
        forEachTriangle(store, 0, format, [&](const read::TriangleCorners& t) { back.push_back(t); });
        EXPECT_EQ(back, triangles);
        EXPECT_EQ(readRequests(store, 1, format), requests);
        std::sort(requests.begin(), requests.end());
        EXPECT_EQ(requests, (std::vector<VertexRequest>{{6, 1, large}, {7, 1, 2}, {7, 0, large}, {7, 1, large}}))
            << "by chunk, then vertex";
        const std::vector<SharedNormal> told = readNormals(store, 2, format);
        ASSERT_EQ(told.size(), 2U);
        EXPECT_EQ(told[0].vertex, large);
        EXPECT_EQ(told[0].normal, 77U);
        EXPECT_EQ(told[1].vertex, 4U);
        EXPECT_EQ(told[1].normal, 0xFFFFFFFFU);
    }
}

} // namespace
} // namespace gnomon::chunk
