#include "preprocess/chunk/chunk_writer.h"

#include "hierarchy/octahedral.h"
#include "preprocess/chunk/field_numbers.h"

#include <algorithm>

namespace gnomon::chunk {

VertexFormat formatOf(const read::MeshSummary& source) {
    return {
        source.isDouble,
        source.hasNormals,
        source.hasColors,
        hierarchy::FieldLayout::of(source.fields.size()),
        source.vertexCount > kMaxNarrowIndex};
}

void ChunkWriter::putVertex(const read::VertexBlock& block, std::size_t i, std::uint32_t chunk) {
    ++sizes_[chunk].vertices;
    if (bins_ == nullptr) return;
    ChunkVertex vertex;
    vertex.index = block.firstVertex + i;
    vertex.position = block.positions[i];
    if (!block.normals.empty()) vertex.normal = hierarchy::packNormal(glm::dvec3(block.normals[i]));
    if (!block.colors.empty()) vertex.color = block.colors[i];
    if (!fields_.empty())
        vertex.fields = packedFields(block.fields.subspan(i * fields_.size(), fields_.size()), fields_);
    VertexBytes storage{};
    bins_->append(streamOf(BinStream::Vertices, chunk), encodeVertex(vertex, format_, storage));
}

void ChunkWriter::putTriangle(const read::TriangleCorners& corners, const std::array<std::uint32_t, 3>& lies) {
    if (std::find(lies.begin(), lies.end(), kOutsideGrid) != lies.end()) {
        ++outsideGrid_;
        return;
    }
    const std::uint32_t owner =
        // the median of the chunks of the three corners
        std::max(std::min(lies[0], lies[1]), std::min(std::max(lies[0], lies[1]), lies[2]));
    if (bins_ != nullptr) chunk::putTriangle(*bins_, streamOf(BinStream::Triangles, owner), corners, format_);
    ++sizes_[owner].triangles;
    if (lies[0] == lies[1] && lies[1] == lies[2]) return;
    request(corners, lies, owner, true);
    if (format_.hasNormals) return;
    for (std::size_t i = 0; i < 3; ++i) {
        const bool isFirst = std::find(lies.begin(), lies.begin() + static_cast<std::ptrdiff_t>(i), lies[i]) ==
                             lies.begin() + static_cast<std::ptrdiff_t>(i);
        if (lies[i] == owner || !isFirst) continue;
        if (bins_ != nullptr) chunk::putTriangle(*bins_, streamOf(BinStream::Ghosts, lies[i]), corners, format_);
        ++sizes_[lies[i]].triangles;
        request(corners, lies, lies[i], false);
    }
}

void ChunkWriter::putFan(std::span<const read::TriangleCorners> fan, std::uint32_t chunk) {
    if (chunk == kOutsideGrid) {
        outsideGrid_ += fan.size();
        return;
    }
    sizes_[chunk].triangles += fan.size();
    if (bins_ == nullptr) return;
    const std::uint32_t stream = streamOf(BinStream::Triangles, chunk);
    chunk::putTriangle(*bins_, stream, {kPolygonMark, fan.size(), 0}, format_);
    for (const read::TriangleCorners& t : fan)
        chunk::putTriangle(*bins_, stream, t, format_);
}

/// Requests from other chunks the corners of a triangle of `chunk` that lie in these chunks.
void ChunkWriter::request(
    const read::TriangleCorners& corners, const std::array<std::uint32_t, 3>& lies, std::uint32_t chunk, bool isOwner) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (lies[i] == chunk) continue;
        if (bins_ != nullptr)
            putRequest(*bins_, streamOf(BinStream::Requests, lies[i]), {chunk, isOwner ? 1U : 0U, corners[i]}, format_);
        ++sizes_[chunk].vertices; // an upper bound: a vertex counts once per triangle
    }
}

} // namespace gnomon::chunk
