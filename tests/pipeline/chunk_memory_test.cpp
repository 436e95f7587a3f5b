// What chunks take while they are loaded, held against what the memory plan counts for them. Every allocation of this
// program is counted.
#include "core/random.h"
#include "preprocess/chunk/binning.h"
#include "preprocess/chunk/chunk_mesh.h"
#include "preprocess/pipeline/memory_plan.h"
#include "tests/pipeline/test_folder.h"
#include "tests/support/code_mesh.h"
#include "tests/support/shared_borders.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include <malloc.h>

namespace {

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): allocations of the whole program
std::atomic<std::size_t> liveBytes{0};
std::atomic<std::size_t> peakBytes{0};

// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

void* counted(void* memory) {
    if (memory == nullptr) throw std::bad_alloc();
    const std::size_t live = liveBytes += ::malloc_usable_size(memory);
    std::size_t peak = peakBytes;
    while (live > peak && !peakBytes.compare_exchange_weak(peak, live)) {
    }
    return memory;
}

void release(void* memory) {
    liveBytes -= ::malloc_usable_size(memory);
    std::free(memory);
}

} // namespace

void* operator new(std::size_t size) {
    return counted(std::malloc(size));
}

void* operator new(std::size_t size, std::align_val_t alignment) {
    const auto unit = static_cast<std::size_t>(alignment);
    return counted(std::aligned_alloc(unit, (size + unit - 1) / unit * unit));
}

void operator delete(void* memory) noexcept {
    release(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
    release(memory);
}

void operator delete(void* memory, std::align_val_t) noexcept {
    release(memory);
}

void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    release(memory);
}

namespace gnomon::pipeline {
namespace {

/// The most bytes at once that `work` takes beside what there was before.
template <class Work>
std::uint64_t peakOf(const Work& work) {
    const std::size_t before = liveBytes;
    peakBytes = before;
    work();
    return peakBytes - before;
}

/// `count` triangles with vertices of their own, one corner in each of three places far apart: as many points there as
/// `spread` says on each axis.
read::CodeMesh threePlaces(std::uint32_t count, std::uint64_t spread) {
    Random random(3);
    std::vector<glm::dvec3> positions;
    std::vector<read::CodeMesh::Triangle> triangles;
    for (std::uint32_t t = 0; t < count; ++t) {
        for (const glm::dvec3 place : {glm::dvec3(0), glm::dvec3(1e6, 0, 0), glm::dvec3(0, 1e6, 0)}) {
            const auto x = static_cast<double>(random.below(spread));
            const auto y = static_cast<double>(random.below(spread));
            positions.push_back(place + glm::dvec3(x, y, static_cast<double>(random.below(spread))));
        }
        triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return {std::move(positions), std::move(triangles)};
}

void expectCountedMemory(read::CodeMesh mesh, std::uint32_t chunkTriangles) {
    NoProgress progress;
    const TestFolder folder;
    chunk::SourceSurvey survey = chunk::surveySource(mesh, progress);
    const chunk::ChunkTree tree = chunk::planChunks(mesh, survey, chunkTriangles, progress);
    scratch::TemporarySpace space(progress);
    const auto binsFile = scratch::scratchOnDisk(folder.file("bins"), space);
    scratch::StreamStore bins(*binsFile, chunk::binStreams(tree.chunkCount()), 4096);
    const chunk::PartSize largest = chunk::binSource(mesh, survey, tree, bins, 1000, progress).largestChunk;
    const auto bordersFile = scratch::scratchOnDisk(folder.file("borders"), space);
    scratch::StreamStore borders(*bordersFile, chunk::borderStreams(tree.chunkCount()), 512);
    const chunk::BinnedSource source{bins, survey.grid, chunk::formatOf(mesh.summary()), tree.chunkCount()};
    EXPECT_LE(peakOf([&] { chunk::shareBorders(source, borders, progress); }), MemoryNeeds::borders(largest).count)
        << "for " << largest.triangles << " triangles and " << largest.vertices << " vertices";
    for (std::uint32_t c = 0; c < tree.chunkCount(); ++c)
        EXPECT_LE(
            peakOf([&] { (void)chunk::loadChunk(source, borders, c, progress); }), MemoryNeeds::node(largest).count)
            << "chunk " << c;
}

TEST(ChunkMemory, OfTrianglesAllOverIsWhatIsCounted) {
    // Their vertices come to just over and just below a power of two, by which tables of them grow.
    expectCountedMemory(threePlaces(22'000, 1000), 11'000);
    expectCountedMemory(threePlaces(21'500, 1000), 11'000);
}

TEST(ChunkMemory, OfTrianglesInFewPlacesIsWhatIsCounted) {
    expectCountedMemory(threePlaces(22'000, 2), 11'000);
    expectCountedMemory(threePlaces(22'000, 3), 11'000);
}

TEST(ChunkMemory, OfAVertexThatAllTrianglesShareIsWhatIsCounted) {
    Random random(5);
    std::vector<glm::dvec3> positions{glm::dvec3(0)};
    std::vector<read::CodeMesh::Triangle> triangles;
    for (std::uint32_t t = 0; t < 20'000; ++t) {
        for (int i = 0; i < 2; ++i)
            positions.emplace_back(random.unit(), random.unit(), random.unit());
        triangles.push_back({0, 2 * t + 1, 2 * t + 2});
    }
    expectCountedMemory({std::move(positions), std::move(triangles)}, 3'000);
}

TEST(ChunkMemory, OfASurfaceIsWhatIsCounted) {
    expectCountedMemory(read::bumpySheet(150), 10'000);
}

} // namespace
} // namespace gnomon::pipeline
