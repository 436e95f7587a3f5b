#include "executor/gl/gl_batch.h"

namespace gnomon::executor {

void GlBatch::add(const PagePlace& place, const hierarchy::Page& page, const selection::ClusterRange& range) {
    const hierarchy::Cluster& first = page.clusters[range.firstCluster];
    const hierarchy::Cluster& last = page.clusters[range.firstCluster + range.clusterCount - 1];
    const std::uint32_t triangles = last.firstTriangle + last.triangleCount - first.firstTriangle;
    if (place.chunk >= draws_.size()) draws_.resize(place.chunk + 1);
    Draws& draws = draws_[place.chunk];
    draws.counts.push_back(static_cast<GLsizei>(triangles * 3));
    const std::size_t offset = place.indexOffset + std::size_t{first.firstTriangle} * 3 * sizeof(std::uint32_t);
    draws.offsets.push_back(reinterpret_cast<const void*>(offset)); // NOLINT(performance-no-int-to-ptr): GL's way
    draws.bases.push_back(place.baseVertex);
}

std::uint64_t GlBatch::flush(const GeometryPool& pool, bool waits) {
    std::uint64_t calls = 0;
    for (std::size_t chunk = 0; chunk < draws_.size(); ++chunk) {
        Draws& draws = draws_[chunk];
        if (draws.counts.empty()) continue;
        api_->bindVertexArray(pool.vertexArray(chunk));
        api_->multiDrawElementsBaseVertex(
            GL_TRIANGLES,
            draws.counts.data(),
            GL_UNSIGNED_INT,
            draws.offsets.data(),
            static_cast<GLsizei>(draws.counts.size()),
            draws.bases.data());
        if (waits) api_->finish();
        calls += draws.counts.size();
        draws = {};
    }
    return calls;
}

} // namespace gnomon::executor
