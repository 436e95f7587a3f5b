// A source that is sorted by ranges of its rows comes to what whole passes come to.
#include "core/random.h"
#include "preprocess/pipeline/build_model.h"
#include "preprocess/pipeline/ranges/range_binning.h"
#include "preprocess/pipeline/ranges/range_bytes.h"
#include "preprocess/pipeline/ranges/range_work.h"
#include "preprocess/pipeline/sort_source.h"
#include "preprocess/pipeline/tasks/task_work.h"
#include "preprocess/read/open_mesh_sources.h"
#include "tests/pipeline/test_folder.h"
#include "tests/support/code_mesh.h"
#include "tests/support/ply_writer.h"

#include <gtest/gtest.h>

namespace gnomon::pipeline {
namespace {

/// Triangles between vertices anywhere, of which some have none and one has very many.
read::CodeMesh tangle(std::uint32_t vertices, std::uint32_t triangles) {
    Random random(3);
    std::vector<glm::dvec3> positions;
    for (std::uint32_t v = 0; v < vertices; ++v)
        positions.emplace_back(random.unit(), random.unit(), random.unit());
    positions.back() = glm::dvec3(1e30); // of no triangle
    std::vector<read::CodeMesh::Triangle> corners;
    for (std::uint32_t t = 0; t < triangles; ++t)
        corners.push_back(
            {static_cast<std::uint32_t>(t % 100 == 0 ? 7 : random.below(vertices - 1)),
             static_cast<std::uint32_t>(random.below(vertices - 1)),
             static_cast<std::uint32_t>(random.below(vertices - 1))});
    return {std::move(positions), std::move(corners)};
}

/// A source as it is without ranges.
class WithoutRanges final : public read::MeshSource {
public:
    explicit WithoutRanges(read::MeshSource& source) : source_(source), summary_(source.summary()) {
        summary_.hasRanges = false;
    }

    const read::MeshSummary& summary() const override { return summary_; }

    void readVertices(const read::VertexSink& sink) override { source_.readVertices(sink); }

    void readTriangles(const read::TriangleSink& sink) override { source_.readTriangles(sink); }

private:
    read::MeshSource& source_;
    read::MeshSummary summary_;
};

class RangeBinningTest : public testing::Test {
protected:
    struct Sorted {
        BinnedRecord record;
        std::vector<std::vector<std::byte>> streams;
        std::uint64_t spaceLeft = 0; // beside the streams
    };

    Sorted sorted(read::MeshSource& source, Bytes memory, std::size_t threads) {
        options.memory = memory;
        scratch::TemporarySpace space(progress);
        const auto scratch = scratch::scratchOnDisk(folder.file("scratch" + std::to_string(number++)), space);
        TaskWork work(source, options.level, *scratch, progress);
        const Perform perform = [&](TaskKind kind, std::span<const std::byte> input) {
            return work.perform(kind, input);
        };
        LocalTasks tasks;
        std::optional<scratch::StreamStore> bins;
        Sorted result;
        result.record = sortSource(
            {source, options, *scratch, tasks, perform, progress, threads, 1, [](const std::string&, std::uint64_t) {}},
            bins);
        tableBytes = work.maxTableBytes();
        result.spaceLeft = space.bytes();
        for (std::uint32_t stream = 0; stream < bins->streamCount(); ++stream) {
            result.streams.push_back(bins->read(stream));
            result.spaceLeft -= result.streams.back().size();
        }
        return result;
    }

    void expectSame(const Sorted& a, const Sorted& b) {
        EXPECT_EQ(a.record.grid.origin, b.record.grid.origin);
        EXPECT_EQ(a.record.grid.stepExponent, b.record.grid.stepExponent);
        EXPECT_EQ(a.record.furthest, b.record.furthest);
        EXPECT_EQ(a.record.triangles, b.record.triangles);
        EXPECT_EQ(a.record.notAPolygon, b.record.notAPolygon);
        EXPECT_EQ(a.record.badNormals, b.record.badNormals);
        EXPECT_EQ(a.record.chunkCount, b.record.chunkCount);
        EXPECT_EQ(a.record.largestChunk.triangles, b.record.largestChunk.triangles);
        EXPECT_EQ(a.record.largestChunk.vertices, b.record.largestChunk.vertices);
        EXPECT_EQ(a.record.dropped, b.record.dropped);
        EXPECT_EQ(a.record.mainPart.min, b.record.mainPart.min);
        EXPECT_EQ(a.record.mainPart.max, b.record.mainPart.max);
        EXPECT_EQ(a.record.medianEdge, b.record.medianEdge);
        EXPECT_EQ(a.record.strayed.triangles, b.record.strayed.triangles);
        EXPECT_EQ(a.record.strayed.corners.min, b.record.strayed.corners.min);
        EXPECT_EQ(a.record.strayed.corners.max, b.record.strayed.corners.max);
        ASSERT_EQ(a.streams.size(), b.streams.size());
        for (std::size_t stream = 0; stream < a.streams.size(); ++stream)
            EXPECT_EQ(a.streams[stream], b.streams[stream]) << stream;
        EXPECT_EQ(a.spaceLeft, 0U);
        EXPECT_EQ(b.spaceLeft, 0U);
    }

    NoProgress progress;
    TestFolder folder;
    BuildOptions options;
    std::uint64_t tableBytes = 0;
    int number = 0;
};

TEST_F(RangeBinningTest, ComesToTheStreamsOfWholePasses) {
    // More than two pages of vertices, and of each range of faces corners in all of them.
    read::CodeMesh mesh = tangle(150'000, 300'000);
    options.chunkTriangles = 20'000;
    const Sorted whole = sorted(mesh, gibibytes(2), 1);
    EXPECT_EQ(tableBytes, 0U);
    EXPECT_GT(whole.record.chunkCount, 10U);
    mesh.withRanges();
    for (const std::size_t threads : {1U, 2U, 7U}) {
        expectSame(whole, sorted(mesh, gibibytes(2), threads));
        EXPECT_GT(tableBytes, 100'000U);
    }
    const Bytes min = MemoryNeeds{mesh.summary(), options.chunkTriangles}.survey();
    expectSame(whole, sorted(mesh, min, 3));
}

TEST_F(RangeBinningTest, LeavesOutTheTrianglesOfWholePassesThatAreBeyondTheGrid) {
    read::CodeMesh sheet = read::bumpySheet(300, 10, {512345, 5403210, 400});
    const auto far = static_cast<std::uint32_t>(sheet.positions.size());
    sheet.positions.insert(sheet.positions.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    sheet.triangles.insert(sheet.triangles.begin() + 70'000, {{far, far + 1, far + 2}, {5, 6, far}});
    read::CodeMesh mesh(sheet.positions, sheet.triangles);
    options.chunkTriangles = 20'000;
    const Sorted whole = sorted(mesh, gibibytes(2), 1);
    EXPECT_EQ(whole.record.strayed.triangles, 2U);
    EXPECT_EQ(whole.record.strayed.corners.min, glm::dvec3(0));
    EXPECT_EQ(whole.record.strayed.corners.max, glm::dvec3(1, 1, 0));
    EXPECT_GT(whole.record.mainPart.min.x, 512340);
    mesh.withRanges();
    for (const std::size_t threads : {1U, 3U})
        expectSame(whole, sorted(mesh, gibibytes(2), threads));
    options.keepsStrays = true;
    const Sorted all = sorted(mesh, gibibytes(2), 3);
    EXPECT_EQ(all.record.strayed.triangles, 0U);
    EXPECT_GT(all.record.grid.step(), 100 * whole.record.grid.step());
    EXPECT_GT(all.record.mainPart.min.x, 512340) << "what views frame is the same";
}

// Of polygons in several chunks, some at a time where there is little memory, and one rank's index in another's hands.
TEST_F(RangeBinningTest, ComesToTheStreamsOfWholePassesOfPolygonsAndText) {
    options.chunkTriangles = 20'000;
    for (const char* format : {"ascii", "binary_little_endian"}) {
        read::PlyLayout layout;
        layout.format = format;
        layout.color = "uchar";
        const std::string path = folder.file(std::string(format) + ".ply");
        read::writeScratch(path, read::plyText(read::randomMesh(5, 140'000, 140'000, layout), layout));
        const auto source = read::openMeshSources({path}, mebibytes(64));
        WithoutRanges plain(*source);
        const Sorted whole = sorted(plain, gibibytes(2), 1);
        EXPECT_EQ(tableBytes, 0U);
        EXPECT_GT(whole.record.chunkCount, 5U);
        EXPECT_GT(whole.record.notAPolygon, 0U);
        const auto again = read::openMeshSources({path}, mebibytes(64));
        expectSame(whole, sorted(*again, gibibytes(2), 5));
        EXPECT_GT(tableBytes, 100'000U);
        const Bytes min = MemoryNeeds{source->summary(), options.chunkTriangles}.survey();
        expectSame(whole, sorted(*source, min, 2));
    }
}

TEST_F(RangeBinningTest, CountsBadNormalsOnceWhateverTheThreads) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex 150000\nproperty float x\nproperty float y\n"
                       "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                       "element face 149998\nproperty list uchar int vertex_indices\nend_header\n";
    for (int v = 0; v < 150'000; ++v)
        text += std::to_string(v / 2) + (v % 2 == 0 ? " 0 0 " : " 1 0 ") + (v % 7 == 3 ? "nan" : "0") + " 0 1\n";
    for (int t = 0; t + 2 < 150'000; ++t)
        text +=
            "3 " + std::to_string(t) + " " + std::to_string(t + 1 + t % 2) + " " + std::to_string(t + 2 - t % 2) + "\n";
    const std::string path = folder.file("normals.ply");
    read::writeScratch(path, text);
    options.chunkTriangles = 20'000;
    const auto source = read::openMeshSources({path}, mebibytes(64));
    WithoutRanges plain(*source);
    const Sorted whole = sorted(plain, gibibytes(2), 1);
    EXPECT_EQ(whole.record.badNormals, 21'429U);
    for (const std::size_t threads : {1U, 4U}) {
        const auto again = read::openMeshSources({path}, mebibytes(64));
        expectSame(whole, sorted(*again, gibibytes(2), threads));
        EXPECT_GT(tableBytes, 0U) << "ranges were read";
    }
}

// What is said of it is what a whole pass says.
TEST_F(RangeBinningTest, GoesOverTheWholeWhereTextHasADefect) {
    read::PlyLayout layout;
    layout.format = "ascii";
    const std::string path = folder.file("defect.ply");
    read::writeScratch(path, read::plyText(read::randomMesh(5, 50, 60, layout), layout) + "more");
    const auto source = read::openMeshSources({path}, mebibytes(64));
    EXPECT_EQ(
        read::errorAbout(path, [&] { (void)sorted(*source, gibibytes(2), 2); }),
        ":122: data after the last element: the header's counts are too small");
}

TEST_F(RangeBinningTest, GoesOverTheWholeWhereARowIsIrregular) {
    read::CodeMesh mesh = read::bumpySheet(100);
    options.chunkTriangles = 1000;
    const Sorted whole = sorted(mesh, gibibytes(2), 1);
    mesh.withRanges(false);
    expectSame(whole, sorted(mesh, gibibytes(2), 2));
}

TEST_F(RangeBinningTest, GoesOverTheWholeWhereTooMuchLiesAtOnePoint) {
    read::CodeMesh mesh = tangle(3000, 6000);
    for (std::size_t v = 0; v < 1000; ++v)
        mesh.positions[v] = glm::dvec3(0.25);
    options.chunkTriangles = 1000;
    const Sorted whole = sorted(mesh, gibibytes(2), 1);
    EXPECT_GT(whole.record.dropped[0] + whole.record.dropped[1], 0U);
    mesh.withRanges();
    expectSame(whole, sorted(mesh, gibibytes(2), 2));
}

// A page of few corners is written as these, and a page comes from several ranges.
TEST_F(RangeBinningTest, PagesAreWrittenWhereNoMoreAreToBeHeld) {
    read::CodeMesh mesh = tangle(400'000, 30'000);
    mesh.withRanges();
    scratch::TemporarySpace space(progress);
    const auto scratch = scratch::scratchInMemory(space);
    const RangeWork work(mesh, *scratch, progress);
    const std::vector<std::byte> none = encoded(read::RowIndex());
    const Blocks noIndex{scratch->append(none)};
    std::vector<unsigned> plain(mesh.positions.size());
    for (const read::CodeMesh::Triangle& t : mesh.triangles)
        for (const std::uint32_t corner : t)
            ++plain[corner];
    const FaceCount count = work.countFaces({{0, 30'000, noIndex}, 4});
    EXPECT_TRUE(count.isRegular);
    EXPECT_GT(count.pages.size(), 20U);
    EXPECT_LE(work.maxTableBytes(), 6 * kPageVertices);
    MeasureInput input{{kPageVertices, 3 * kPageVertices, noIndex}, {}, {}};
    for (const auto& [page, block] : count.pages)
        if (page == 1 || page == 2) input.pages.push_back({page, block});
    const VertexMeasure measure = work.measureVertices(input);
    ASSERT_EQ(measure.valence.size(), 1U);
    const std::vector<std::byte> valence = scratch->read(measure.valence);
    ASSERT_EQ(valence.size(), 2 * kPageVertices);
    for (std::size_t i = 0; i < valence.size(); ++i)
        ASSERT_EQ(std::to_integer<unsigned>(valence[i]), std::min(plain[kPageVertices + i], 255U));
    EXPECT_TRUE(measure.positions.empty());
}

TEST(RangeBytes, ComeBackAndAreRefusedWhereTheyEndEarly) {
    const Blocks blocks{{100, 20, 5}, {std::uint64_t{1} << 50U, 3, std::uint64_t{1} << 63U}};
    const RowRange range{7, std::uint64_t{1} << 40U, blocks};
    VertexMeasure measure;
    measure.box.add(glm::dvec3(1, 2, 3));
    measure.fields = {{-1, 2}};
    measure.valence = blocks;
    measure.badNormals = 300;
    const VertexMeasure measured = decodedMeasure(encoded(measure));
    EXPECT_EQ(measured.box.max, glm::dvec3(1, 2, 3));
    EXPECT_EQ(measured.fields, measure.fields);
    EXPECT_EQ(measured.badNormals, 300U);
    ASSERT_EQ(measured.valence.size(), 2U);
    EXPECT_EQ(measured.valence[1].offset, blocks[1].offset);
    BinnedRange binned;
    binned.streams = {{5, blocks[0]}};
    binned.sizes = {{70'000, {8, 9}}};
    binned.chunks = blocks;
    binned.strayed = {12, {glm::dvec3(1), glm::dvec3(2)}};
    const BinnedRange back = decodedBinnedRange(encoded(binned));
    EXPECT_EQ(back.streams[0].first, 5U);
    EXPECT_EQ(back.sizes[0].first, 70'000U);
    EXPECT_EQ(back.sizes[0].second.vertices, 9U);
    EXPECT_EQ(back.strayed.triangles, 12U);
    EXPECT_EQ(back.strayed.corners.max, glm::dvec3(2));
    const FaceCount counted = decodedFaceCount(encoded(FaceCount{true, 5, 6, true, {{3, blocks[0]}}, blocks}));
    EXPECT_TRUE(counted.isRegular);
    EXPECT_EQ(counted.pages[0].second.bytes, 20U);
    EXPECT_EQ(counted.triangles, 5U);
    EXPECT_EQ(counted.notAPolygon, 6U);
    EXPECT_TRUE(counted.hasPolygons);
    const read::RowIndex index{{{{{7, 8, 0}}, {{9, 10, 11}, {12, 13, 14}}, 15}}};
    const read::RowIndex indexed = decodedRowIndex(encoded(index));
    ASSERT_EQ(indexed.parts.size(), 1U);
    EXPECT_EQ(indexed.parts[0].vertices[0].line, 8U);
    EXPECT_EQ(indexed.parts[0].faces[1].triangle, 14U);
    EXPECT_EQ(indexed.parts[0].triangles, 15U);
    BinVerticesInput vertices{range, {}, {{"f", 1, 2, 16}}, blocks, blocks, 4096};
    vertices.facts.grid.stepExponent = -9;
    vertices.facts.furthest = {1, 2, 3};
    const std::vector<std::byte> bytes = encoded(vertices);
    hierarchy::ByteReader in(bytes);
    const BinVerticesInput taken = takeBinVerticesInput(in);
    EXPECT_EQ(taken.vertices.end, range.end);
    EXPECT_EQ(taken.vertices.index[1].offset, blocks[1].offset);
    EXPECT_EQ(taken.facts.grid.stepExponent, -9);
    EXPECT_EQ(taken.facts.furthest, vertices.facts.furthest);
    EXPECT_EQ(taken.fields[0].name, "f");
    EXPECT_EQ(taken.fields[0].bits, 16);
    EXPECT_EQ(taken.blockBytes, 4096U);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        hierarchy::ByteReader cut{std::span(bytes).first(size)};
        EXPECT_THROW((void)takeBinVerticesInput(cut), hierarchy::Damage);
    }
    const std::vector<std::byte> backwards = encoded(CountInput{{9, 8, {}}, 1});
    hierarchy::ByteReader bad(backwards);
    EXPECT_THROW((void)takeCountInput(bad), hierarchy::Damage);
}

} // namespace
} // namespace gnomon::pipeline
