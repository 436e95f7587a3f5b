// Writes the vertices and triangles of a source to the byte streams of their chunks.
#pragma once

#include "hierarchy/model.h"
#include "preprocess/chunk/chunk_streams.h"
#include "preprocess/chunk/chunk_tree.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace gnomon::chunk {

/// Returns the format of the vertex records for the source mesh that `source` describes.
VertexFormat formatOf(const read::MeshSummary& source);

/// Returns true if all corners of a polygon lie in one chunk. `fan` is the triangulation of the polygon.
/// `chunkOf(vertex)` returns the chunk of a vertex.
template <class ChunkOf>
bool isInOneChunk(std::span<const read::TriangleCorners> fan, ChunkOf chunkOf) {
    const std::uint32_t chunk = chunkOf(fan.front()[0]);
    return std::all_of(fan.begin(), fan.end(), [&](const read::TriangleCorners& t) {
        return std::all_of(t.begin(), t.end(), [&](std::uint64_t corner) { return chunkOf(corner) == chunk; });
    });
}

/// Writes the vertices and triangles of a source to the streams of their chunks, and counts them. A writer without a
/// store only counts.
class ChunkWriter {
public:
    /// Creates a writer. `fields` and `bins` must outlive it. If `bins` is null, the writer only counts.
    ChunkWriter(
        const VertexFormat& format,
        std::span<const hierarchy::Field> fields,
        scratch::StreamStore* bins,
        std::uint32_t chunkCount)
        : format_(format), fields_(fields), bins_(bins), sizes_(chunkCount) {}

    /// Writes vertex `i` of a block to the stream of `chunk`.
    void putVertex(const read::VertexBlock& block, std::size_t i, std::uint32_t chunk);

    /// Writes a triangle to the stream of its chunk. `lies` contains the chunks of the triangle's three corners. If one
    /// of them is kOutsideGrid, the function only counts the triangle.
    void putTriangle(const read::TriangleCorners& corners, const std::array<std::uint32_t, 3>& lies);

    /// Writes the triangulation `fan` of a polygon to the stream of `chunk`. If `chunk` is kOutsideGrid, the function
    /// only counts the triangles.
    void putFan(std::span<const read::TriangleCorners> fan, std::uint32_t chunk);

    /// Adds the triangles and vertices of `more` to the size of `chunk`.
    void count(std::uint32_t chunk, const PartSize& more) {
        sizes_[chunk].triangles += more.triangles;
        sizes_[chunk].vertices += more.vertices;
    }

    /// Returns the number of triangles and vertices of each chunk.
    const std::vector<PartSize>& sizes() const { return sizes_; }

    /// Returns the number of triangles with a corner outside the range of the grid. No chunk contains these triangles.
    std::uint64_t outsideGrid() const { return outsideGrid_; }

private:
    void request(
        const read::TriangleCorners& corners,
        const std::array<std::uint32_t, 3>& lies,
        std::uint32_t chunk,
        bool isOwner);

    VertexFormat format_;
    std::span<const hierarchy::Field> fields_;
    scratch::StreamStore* bins_; // the output; null if the object only counts
    std::vector<PartSize> sizes_;
    std::uint64_t outsideGrid_ = 0;
};

} // namespace gnomon::chunk
