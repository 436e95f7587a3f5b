#include "preprocess/pipeline/memory_plan.h"

#include "core/check.h"

#include <algorithm>

namespace gnomon::preprocess {

namespace {

constexpr Bytes kProcess = mebibytes(64);
constexpr Bytes kSample = mebibytes(72);
constexpr std::uint64_t kNodeBytesPerTriangle = 360;
constexpr std::uint64_t kScratchBytesPerTriangle = 44; // where temporary files are in memory
constexpr std::uint64_t kPageRowBytesPerTriangle = 1;  // rows of the page table, blocks of the streams
constexpr std::size_t kLeastBlock = 512;
constexpr std::size_t kLargestBlock = std::size_t{64} << 10U;

std::uint64_t trianglesOf(const MeshSummary& source) {
    return std::max(source.faceCount, source.stripCount > 0 ? 2 * source.vertexCount : 0);
}

} // namespace

Bytes MemoryNeeds::base() const {
    const std::uint64_t scratch = isInMemory ? trianglesOf(source) * kScratchBytesPerTriangle : 0;
    return {kProcess.count + source.heldBytes + trianglesOf(source) * kPageRowBytesPerTriangle + scratch};
}

Bytes MemoryNeeds::node(std::uint64_t triangles) {
    return {triangles * kNodeBytesPerTriangle};
}

Bytes MemoryNeeds::survey() const {
    return {base().count + source.vertexCount + kSample.count};
}

Bytes MemoryNeeds::binning() const {
    return {base().count + source.vertexCount * 3};
}

Bytes MemoryNeeds::least() const {
    const std::uint64_t chunks = trianglesOf(source) / chunkTriangles + 1;
    const std::uint64_t nodeTriangles = std::min<std::uint64_t>(chunkTriangles, trianglesOf(source));
    return {std::max(
        {survey().count, binning().count + 3 * chunks * 2 * kLeastBlock, base().count + node(nodeTriangles).count})};
}

std::size_t blockBytes(Bytes room, std::uint64_t streams) {
    return static_cast<std::size_t>(std::clamp<std::uint64_t>(room.count / streams, kLeastBlock, kLargestBlock));
}

std::size_t nodesAtOnce(Bytes room, std::uint64_t triangles, std::size_t threads) {
    const std::uint64_t each = std::max<std::uint64_t>(MemoryNeeds::node(triangles).count, 1);
    return static_cast<std::size_t>(std::min<std::uint64_t>(room.count / each, threads + 1));
}

BorderShare borderShare(Bytes room, std::uint64_t triangles, std::size_t threads) {
    const std::uint64_t chunk = MemoryNeeds::node(triangles).count;
    GNOMON_CHECK_OP(chunk, <=, room.count);
    const Bytes blocks = {std::min(room.count / 4, room.count - chunk)};
    return {blocks, nodesAtOnce({room.count - blocks.count}, triangles, threads)};
}

} // namespace gnomon::preprocess
