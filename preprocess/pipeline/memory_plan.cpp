#include "preprocess/pipeline/memory_plan.h"

#include <algorithm>

namespace gnomon::pipeline {

namespace {

constexpr Bytes kProcess = mebibytes(19);      // the process while it sorts the source
constexpr Bytes kBuilding = mebibytes(3);      // code and small tables that only building nodes uses
constexpr std::uint64_t kMaxSampled = 540'000; // upper bound of the triangles of an edge sample
constexpr std::uint64_t kSampleBytesPerTriangle = 96;
constexpr std::uint64_t kSampleBytesPerVertex = 24;
constexpr std::uint64_t kReadingBytes = std::uint64_t{5} << 20U; // a buffer of the file and the rows of one block
constexpr std::uint64_t kMinReadingBytes = std::uint64_t{256} << 10U;
constexpr std::uint64_t kTableBytes = std::uint64_t{4} << 20U;
constexpr std::uint64_t kTableBytesPerVertex = 8;
constexpr std::uint64_t kBytesPerCell = 12; // bytes per cell of the first table of an octree
constexpr std::uint64_t kBorderBytesPerVertex = 108;
constexpr std::uint64_t kBorderBytesPerTriangle = 64;
constexpr std::uint64_t kRoutingBytesPerVertex = 64;   // in addition to the records and their copies
constexpr std::uint64_t kScratchBytesPerTriangle = 44; // if temporary files are in memory
// Number of triangles per byte of the page table. Measured tables need 0.036 to 0.048 bytes per triangle.
constexpr std::uint64_t kTrianglesPerPageRowByte = 16;
constexpr std::uint32_t kMinFullChunk = 1U << 16U; // number of triangles; smaller chunks have mostly empty pages
constexpr std::uint64_t kFullPageTriangles = 1U << 20U;
constexpr std::size_t kMinBlock = 512;
constexpr std::size_t kLargestBlock = std::size_t{64} << 10U;

std::uint64_t trianglesOf(const read::MeshSummary& source) {
    return std::max(source.faceCount, source.likelyTriangles);
}

/// Returns the size of the rows of the page table and of the node records in bytes. Small chunks need one byte per
/// triangle. The first kFullPageTriangles triangles also need one byte each, because the coarse levels of a chunk have
/// their own pages.
std::uint64_t pageRowBytes(std::uint64_t triangles, std::uint32_t chunkTriangles) {
    if (chunkTriangles < kMinFullChunk) return triangles;
    return std::min(triangles, kFullPageTriangles) + triangles / kTrianglesPerPageRowByte;
}

} // namespace

Bytes MemoryNeeds::base() const {
    const std::uint64_t scratch = isInMemory ? trianglesOf(source) * kScratchBytesPerTriangle : 0;
    return {kProcess.count + source.heldBytes + pageRowBytes(trianglesOf(source), chunkTriangles) + scratch};
}

// The factors are measured with scans, plants, LEGO models, coloured scans and triangle soups. Loading a chunk needs up
// to 20 bytes per triangle and 130 bytes per vertex. Forming its first clusters needs 109 bytes per triangle.
// Simplifying them needs 60 bytes per triangle, 62 bytes per vertex, and 8 bytes per vertex and thread.
Bytes MemoryNeeds::node(const chunk::PartSize& size, std::size_t threads) {
    const std::uint64_t loading = 20 * size.triangles + 130 * size.vertices;
    const std::uint64_t clustering = 109 * size.triangles;
    const std::uint64_t simplifying = 60 * size.triangles + (62 + 8 * threads) * size.vertices;
    return {std::max({loading, clustering, simplifying})};
}

Bytes MemoryNeeds::borders(const chunk::PartSize& size) {
    return std::min(
        Bytes{size.triangles * kBorderBytesPerTriangle + size.vertices * kBorderBytesPerVertex}, node(size));
}

Bytes MemoryNeeds::routing(std::uint64_t bytes, std::uint64_t vertices) {
    return {2 * bytes + vertices * kRoutingBytesPerVertex};
}

Bytes MemoryNeeds::minRangeTables(const read::MeshSummary& source) {
    return {std::min(kTableBytes, (std::uint64_t{512} << 10U) + kTableBytesPerVertex * source.vertexCount)};
}

namespace {

std::uint64_t readingBytes(const read::MeshSummary& source) {
    return std::min(kReadingBytes, kMinReadingBytes + source.fileBytes);
}

std::uint64_t cellBytes(const read::MeshSummary& source) {
    return kBytesPerCell << static_cast<unsigned>(3 * chunk::rootBitsFor(source.vertexCount));
}

/// Returns the size of the edge sample in bytes. The sample contains triangles and the positions of their corners.
std::uint64_t sampleBytes(const read::MeshSummary& source) {
    const std::uint64_t triangles = std::min(trianglesOf(source), kMaxSampled);
    return kSampleBytesPerTriangle * triangles + kSampleBytesPerVertex * std::min(source.vertexCount, 3 * triangles);
}

} // namespace

Bytes MemoryNeeds::rangeTask(const read::MeshSummary& source) {
    return {readingBytes(source) + cellBytes(source) + minRangeTables(source).count};
}

Bytes MemoryNeeds::ranges() const {
    return {base().count + sampleBytes(source)};
}

Bytes MemoryNeeds::survey() const {
    if (source.hasRanges && !isSerial) return {ranges().count + rangeTask(source).count};
    return {
        base().count + source.vertexCount + readingBytes(source) + std::max(sampleBytes(source), cellBytes(source))};
}

Bytes MemoryNeeds::binning() const {
    if (source.hasRanges && !isSerial) return survey();
    // The number of chunks is at most twice the min number. A chunk is at least seven eighths full unless it ends
    // before a heavy point (a grid point with very many triangles).
    const std::uint64_t maxChunks = 2 * (trianglesOf(source) / chunkTriangles + 1);
    return {base().count + readingBytes(source) + source.vertexCount * (maxChunks > chunk::kNarrowChunks ? 5 : 3)};
}

Bytes MemoryNeeds::sorting() const {
    const std::uint64_t chunks = trianglesOf(source) / chunkTriangles + 1;
    return {std::max(survey().count, binning().count + 3 * chunks * 2 * kMinBlock)};
}

Bytes MemoryNeeds::building(const chunk::PartSize& largest) const {
    return {base().count + kBuilding.count + node(largest, threads).count};
}

Bytes MemoryNeeds::peak() const {
    chunk::PartSize largest;
    largest.triangles = std::min<std::uint64_t>(chunkTriangles, trianglesOf(source));
    // The largest chunk may have more vertices per triangle than the whole source.
    largest.vertices = std::min(
        {3 * largest.triangles,
         source.vertexCount,
         2 * largest.triangles * source.vertexCount / std::max<std::uint64_t>(trianglesOf(source), 1)});
    return {std::max(sorting(), building(largest))};
}

std::size_t blockBytes(Bytes room, std::uint64_t streams) {
    return static_cast<std::size_t>(std::clamp<std::uint64_t>(room.count / streams, kMinBlock, kLargestBlock));
}

std::size_t countAtOnce(Bytes room, Bytes each, std::size_t threads) {
    return static_cast<std::size_t>(
        std::min<std::uint64_t>(room.count / std::max<std::uint64_t>(each.count, 1), threads + 1));
}

} // namespace gnomon::pipeline
