#include "preprocess/pipeline/memory_plan.h"

#include <algorithm>

namespace gnomon::pipeline {

namespace {

constexpr Bytes kProcess = mebibytes(64);
constexpr Bytes kSample = mebibytes(72);
constexpr std::uint64_t kSampleBytesPerTriangle = 160;
constexpr Bytes kRangeReading = mebibytes(5); // a window over the file, rows of a block
constexpr std::uint64_t kBytesPerCell = 12;   // of the first table of an octree
constexpr std::uint64_t kNodeBytesPerTriangle = 130;
constexpr std::uint64_t kNodeBytesPerVertex = 110;
constexpr std::uint64_t kBorderBytesPerVertex = 108;
constexpr std::uint64_t kBorderBytesPerTriangle = 64;
constexpr std::uint64_t kRoutingBytesPerVertex = 64;   // beside the records and their copies
constexpr std::uint64_t kScratchBytesPerTriangle = 44; // where temporary files are in memory
constexpr std::uint64_t kTrianglesPerPageRowByte = 16; // rows of the page table: 0.036 to 0.048 bytes measured
constexpr std::uint32_t kLeastFullChunk = 1U << 16U;   // triangles; smaller ones leave most of their pages empty
constexpr std::uint64_t kFullPageTriangles = 1U << 20U;
constexpr std::size_t kLeastBlock = 512;
constexpr std::size_t kLargestBlock = std::size_t{64} << 10U;

std::uint64_t trianglesOf(const read::MeshSummary& source) {
    return std::max(source.faceCount, source.likelyTriangles);
}

/// Rows of the page table and records of nodes: a byte a triangle where chunks are small, and of the first chunk,
/// whose coarse levels have pages of their own.
std::uint64_t pageRowBytes(std::uint64_t triangles, std::uint32_t chunkTriangles) {
    if (chunkTriangles < kLeastFullChunk) return triangles;
    return std::min(triangles, kFullPageTriangles) + triangles / kTrianglesPerPageRowByte;
}

} // namespace

Bytes MemoryNeeds::base() const {
    const std::uint64_t scratch = isInMemory ? trianglesOf(source) * kScratchBytesPerTriangle : 0;
    return {kProcess.count + source.heldBytes + pageRowBytes(trianglesOf(source), chunkTriangles) + scratch};
}

Bytes MemoryNeeds::node(const chunk::PartSize& size) {
    return {size.triangles * kNodeBytesPerTriangle + size.vertices * kNodeBytesPerVertex};
}

Bytes MemoryNeeds::borders(const chunk::PartSize& size) {
    return {size.triangles * kBorderBytesPerTriangle + size.vertices * kBorderBytesPerVertex};
}

Bytes MemoryNeeds::routing(std::uint64_t bytes, std::uint64_t vertices) {
    return {2 * bytes + vertices * kRoutingBytesPerVertex};
}

Bytes MemoryNeeds::leastRangeTables() {
    return mebibytes(4);
}

Bytes MemoryNeeds::rangeTask(const read::MeshSummary& source) {
    const std::uint64_t cells = std::uint64_t{1} << static_cast<unsigned>(3 * chunk::rootBitsFor(source.vertexCount));
    return {kRangeReading.count + kBytesPerCell * cells + leastRangeTables().count};
}

Bytes MemoryNeeds::ranges() const {
    return {base().count + std::min(kSample.count, kSampleBytesPerTriangle * trianglesOf(source))};
}

Bytes MemoryNeeds::survey() const {
    if (source.hasRanges && !isSerial) return {ranges().count + rangeTask(source).count};
    return {base().count + source.vertexCount + kSample.count};
}

Bytes MemoryNeeds::binning() const {
    if (source.hasRanges && !isSerial) return survey();
    // A chunk is at least seven eighths full, but for those that close before a heavy point.
    const std::uint64_t mostChunks = 2 * (trianglesOf(source) / chunkTriangles + 1);
    return {base().count + source.vertexCount * (mostChunks > chunk::kNarrowChunks ? 5 : 3)};
}

Bytes MemoryNeeds::least() const {
    const std::uint64_t chunks = trianglesOf(source) / chunkTriangles + 1;
    chunk::PartSize most;
    most.triangles = std::min<std::uint64_t>(chunkTriangles, trianglesOf(source));
    // A chunk may have more of them than the whole has on the average.
    most.vertices = std::min(
        {3 * most.triangles,
         source.vertexCount,
         2 * most.triangles * source.vertexCount / std::max<std::uint64_t>(trianglesOf(source), 1)});
    return {
        std::max({survey().count, binning().count + 3 * chunks * 2 * kLeastBlock, base().count + node(most).count})};
}

std::size_t blockBytes(Bytes room, std::uint64_t streams) {
    return static_cast<std::size_t>(std::clamp<std::uint64_t>(room.count / streams, kLeastBlock, kLargestBlock));
}

std::size_t countAtOnce(Bytes room, Bytes each, std::size_t threads) {
    return static_cast<std::size_t>(
        std::min<std::uint64_t>(room.count / std::max<std::uint64_t>(each.count, 1), threads + 1));
}

} // namespace gnomon::pipeline
