#include "render/gl/gl_batch.h"

#include <algorithm>
#include <cstring>

namespace gnomon::render {

void appendCommands(
    std::vector<DrawCommand>& commands,
    const PagePlace& place,
    const hierarchy::Page& page,
    const lod::ClusterRange& range) {
    const auto clusters = std::span(page.clusters).subspan(range.firstCluster, range.clusterCount);
    for (auto first = clusters.begin(); first != clusters.end();) {
        const std::uint32_t base = indexBase(*first);
        const auto end = std::find_if(
            first, clusters.end(), [&](const hierarchy::Cluster& cluster) { return indexBase(cluster) != base; });
        const hierarchy::Cluster& last = *(end - 1);
        DrawCommand command;
        command.count = (last.firstTriangle + last.triangleCount - first->firstTriangle) * 3;
        command.firstIndex = place.firstIndex + first->firstTriangle * 3;
        command.baseVertex = place.baseVertex + static_cast<GLint>(base);
        commands.push_back(command);
        first = end;
    }
}

void GlBatch::add(const PagePlace& place, const hierarchy::Page& page, const lod::ClusterRange& range) {
    if (place.chunk >= draws_.size()) draws_.resize(place.chunk + 1);
    appendCommands(draws_[place.chunk], place, page, range);
}

std::uint64_t GlBatch::flush(const GeometryPool& pool, bool waits) {
    std::uint64_t ranges = 0;
    for (std::size_t chunk = 0; chunk < draws_.size(); ++chunk) {
        std::span<const DrawCommand> left = draws_[chunk];
        if (left.empty()) continue;
        api_->bindVertexArray(pool.vertexArray(chunk, withAttributes_));
        while (!left.empty()) {
            const std::size_t count = std::min(left.size(), commands_->segmentBytes() / sizeof(DrawCommand));
            const gl::RingPiece piece = commands_->take(count * sizeof(DrawCommand));
            std::memcpy(piece.bytes.data(), left.data(), piece.bytes.size());
            api_->bindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_->id());
            // NOLINTNEXTLINE(performance-no-int-to-ptr): GL takes offsets as pointers
            const void* const offset = reinterpret_cast<const void*>(piece.offset);
            api_->multiDrawElementsIndirect(
                GL_TRIANGLES, GL_UNSIGNED_SHORT, offset, static_cast<GLsizei>(count), sizeof(DrawCommand));
            if (waits) api_->finish();
            ranges += count;
            left = left.subspan(count);
        }
        draws_[chunk].clear();
    }
    return ranges;
}

} // namespace gnomon::render
