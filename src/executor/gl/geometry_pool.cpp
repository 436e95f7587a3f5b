#include "executor/gl/geometry_pool.h"

#include "core/check.h"
#include "core/error.h"
#include "core/random.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::executor {

namespace {

constexpr std::size_t kUnitBytes = sizeof(PackedVertex);
static_assert(kUnitBytes == 20, "the vertex layout below");

constexpr Bytes kChunkBytes = mebibytes(32);

constexpr std::array<gl::Attribute, 3> kAttributes = {
    gl::Attribute{0, 3, GL_UNSIGNED_INT, true, 0},
    gl::Attribute{1, 1, GL_UNSIGNED_INT, true, 12},
    gl::Attribute{2, 4, GL_UNSIGNED_BYTE, false, 16}};

/// The code of an error in eighths of an octave above the grid's step, rounded up; 0 is none.
std::uint32_t errorCode(double error, double step) {
    if (!(error > 0)) return 0;
    const double code = std::ceil(8 * std::log2(error / step)) + 9;
    return static_cast<std::uint32_t>(std::clamp(code, 1.0, 255.0));
}

std::vector<std::uint32_t> pageIndices(const hierarchy::Page& page) {
    std::vector<std::uint32_t> indices;
    indices.reserve(page.triangles.size() * 3);
    for (const hierarchy::Cluster& cluster : page.clusters)
        for (std::uint32_t t = 0; t < cluster.triangleCount; ++t)
            for (const std::uint8_t corner : page.triangles[cluster.firstTriangle + t])
                indices.push_back(cluster.firstVertex + corner);
    return indices;
}

} // namespace

double storedError(const hierarchy::Page& page, const hierarchy::Cluster& cluster, const hierarchy::Grid& grid) {
    return cluster.refinement == hierarchy::kNone ? grid.snapError()
                                                  : page.refinements[cluster.refinement].drawnError();
}

std::vector<PackedVertex> packedVertices(std::uint32_t id, const hierarchy::Page& page, const hierarchy::Grid& grid) {
    constexpr unsigned kTopBit = 31;
    std::vector<PackedVertex> vertices(page.vertices.begin(), page.vertices.end());
    for (std::size_t c = 0; c < page.clusters.size(); ++c) {
        const hierarchy::Cluster& cluster = page.clusters[c];
        const std::uint32_t error = errorCode(storedError(page, cluster, grid), grid.step());
        const auto tint = static_cast<std::uint32_t>(mix64(std::uint64_t{id} << 32U | c));
        for (std::uint32_t v = cluster.firstVertex; v < cluster.firstVertex + cluster.vertexCount; ++v) {
            PackedVertex& vertex = vertices[v];
            vertex.color = (vertex.color & 0x00FFFFFFU) | error << 24U;
            vertex.position.x |= (tint & 1U) << kTopBit;
            vertex.position.y |= (tint >> 1U & 1U) << kTopBit;
            vertex.position.z |= (tint >> 2U & 1U) << kTopBit;
        }
    }
    return vertices;
}

GeometryPool::GeometryPool(const gl::Api& api, Bytes cap) : api_(&api), cap_(cap) {}

Bytes GeometryPool::size() const {
    Bytes sum;
    for (const Chunk& chunk : chunks_)
        sum.count += chunk.buffer.size();
    return sum;
}

void GeometryPool::keepUnder(Bytes cap) {
    cap_ = cap;
    while (size() > cap_) {
        const std::size_t last = chunks_.size() - 1;
        for (auto entry = byUse_.begin(); entry != byUse_.end();) {
            if (entry->place.chunk == last) {
                entries_.erase(entry->id);
                entry = byUse_.erase(entry);
            } else {
                ++entry;
            }
        }
        chunks_.pop_back();
    }
}

std::optional<PagePlace> GeometryPool::find(std::uint32_t page) {
    const auto found = entries_.find(page);
    if (found == entries_.end()) return std::nullopt;
    byUse_.splice(byUse_.begin(), byUse_, found->second);
    return found->second->place;
}

bool GeometryPool::addChunk(std::size_t units) {
    const std::uint64_t left = cap_.count - std::min(cap_.count, size().count);
    std::uint64_t bytes = std::min(std::max<std::uint64_t>(kChunkBytes.count, units * kUnitBytes), left);
    bytes -= bytes % kUnitBytes;
    if (bytes < units * kUnitBytes) return false;
    gl::Buffer buffer(*api_, bytes);
    gl::VertexArray vertices(*api_, buffer, static_cast<GLsizei>(kUnitBytes), kAttributes);
    chunks_.push_back({std::move(buffer), std::move(vertices), FreeList(bytes / kUnitBytes)});
    return true;
}

std::optional<PagePlace> GeometryPool::place(std::size_t vertexCount, std::size_t units) {
    for (std::size_t c = 0; c < chunks_.size(); ++c)
        if (const auto offset = chunks_[c].space.take(units))
            return PagePlace{c, static_cast<GLint>(*offset), (*offset + vertexCount) * kUnitBytes};
    if (!addChunk(units)) return std::nullopt;
    return place(vertexCount, units);
}

std::optional<PagePlace> GeometryPool::insert(
    std::uint32_t id, const hierarchy::Page& page, const hierarchy::Grid& grid) {
    const std::vector<PackedVertex> vertices = packedVertices(id, page, grid);
    const std::vector<std::uint32_t> indices = pageIndices(page);
    const std::size_t indexUnits = (indices.size() * sizeof(std::uint32_t) + kUnitBytes - 1) / kUnitBytes;
    const std::size_t units = page.vertices.size() + indexUnits;
    const auto found = place(page.vertices.size(), units);
    if (!found && entries_.empty())
        throw Error(
            "drawing memory",
            "a page of the model does not fit",
            readableBytes({units * kUnitBytes}),
            readableBytes(cap_));
    if (!found) return std::nullopt;
    const gl::Buffer& buffer = chunks_[found->chunk].buffer;
    buffer.write(static_cast<std::size_t>(found->baseVertex) * kUnitBytes, std::as_bytes(std::span(vertices)));
    buffer.write(found->indexOffset, std::as_bytes(std::span(indices)));
    byUse_.push_front({id, *found, units});
    entries_.emplace(id, byUse_.begin());
    return found;
}

bool GeometryPool::evictOldest() {
    if (byUse_.empty()) return false;
    const Entry& oldest = byUse_.back();
    chunks_[oldest.place.chunk].space.release(static_cast<std::size_t>(oldest.place.baseVertex), oldest.units);
    entries_.erase(oldest.id);
    byUse_.pop_back();
    return true;
}

} // namespace gnomon::executor
