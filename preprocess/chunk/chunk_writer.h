// Hands vertices and triangles of a source to the streams of the chunks in which they lie.
#pragma once

#include "hierarchy/model.h"
#include "preprocess/chunk/chunk_streams.h"
#include "preprocess/chunk/chunk_tree.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace gnomon::chunk {

VertexFormat formatOf(const read::MeshSummary& source);

/// Whether all corners of a polygon, given as its fan, lie in one chunk; `chunkOf(vertex)` is the chunk of a vertex.
template <class ChunkOf>
bool isInOneChunk(std::span<const read::TriangleCorners> fan, ChunkOf chunkOf) {
    const std::uint32_t chunk = chunkOf(fan.front()[0]);
    return std::all_of(fan.begin(), fan.end(), [&](const read::TriangleCorners& t) {
        return std::all_of(t.begin(), t.end(), [&](std::uint64_t corner) { return chunkOf(corner) == chunk; });
    });
}

/// Counts what each chunk gets; without a store it does no more.
class ChunkWriter {
public:
    /// Both must outlive it.
    ChunkWriter(
        const VertexFormat& format,
        std::span<const hierarchy::Field> fields,
        scratch::StreamStore* bins,
        std::uint32_t chunkCount)
        : format_(format), fields_(fields), bins_(bins), sizes_(chunkCount) {}

    /// Vertex `i` of a block, which lies in `chunk`.
    void putVertex(const read::VertexBlock& block, std::size_t i, std::uint32_t chunk);

    /// A triangle whose corners lie in the chunks `lies`. If one of these is kBeyondGrid, it only counts the triangle.
    void putTriangle(const read::TriangleCorners& corners, const std::array<std::uint32_t, 3>& lies);

    /// A polygon that lies in `chunk`, as a fan. If this is kBeyondGrid, it only counts the triangles.
    void putFan(std::span<const read::TriangleCorners> fan, std::uint32_t chunk);

    /// What `chunk` gets besides.
    void count(std::uint32_t chunk, const PartSize& more) {
        sizes_[chunk].triangles += more.triangles;
        sizes_[chunk].vertices += more.vertices;
    }

    /// Of each chunk.
    const std::vector<PartSize>& sizes() const { return sizes_; }

    /// Returns how many triangles have a corner beyond the grid's range. No chunk receives them.
    std::uint64_t beyondGrid() const { return beyondGrid_; }

private:
    void request(
        const read::TriangleCorners& corners,
        const std::array<std::uint32_t, 3>& lies,
        std::uint32_t chunk,
        bool isOwner);

    VertexFormat format_;
    std::span<const hierarchy::Field> fields_;
    scratch::StreamStore* bins_; // none where it only counts
    std::vector<PartSize> sizes_;
    std::uint64_t beyondGrid_ = 0;
};

} // namespace gnomon::chunk
