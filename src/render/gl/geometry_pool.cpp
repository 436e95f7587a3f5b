#include "render/gl/geometry_pool.h"

#include "core/check.h"
#include "core/limit_error.h"
#include "core/random.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace gnomon::render {

namespace {

using Index = std::uint16_t;

/// The attributes of a vertex in the GL buffer, without the position.
struct PackedAttributes {
    std::uint32_t normal = 0;
    std::uint32_t color = 0;
};

constexpr std::size_t kPositionBytes = sizeof(hierarchy::GridPoint);
constexpr std::size_t kVertexBytes = kPositionBytes + sizeof(PackedAttributes);
static_assert(kPositionBytes == 12 && kVertexBytes == 20, "the vertex layout below");

constexpr Bytes kMinChunk = mebibytes(32);
constexpr Bytes kMaxChunk = mebibytes(128);

constexpr std::array<gl::Attribute, 3> kAttributes = {
    gl::Attribute{0, 3, GL_UNSIGNED_INT, true, 0, 0},
    gl::Attribute{1, 1, GL_UNSIGNED_INT, true, 0, 1},
    gl::Attribute{2, 4, GL_UNSIGNED_BYTE, false, 4, 1}};

/// A page in the memory layout of the GL buffers.
struct PackedPage {
    std::vector<hierarchy::GridPoint> positions;
    std::vector<PackedAttributes> attributes;
    std::vector<Index> indices;
};

PackedPage packed(std::uint32_t id, const hierarchy::Page& page, const hierarchy::Grid& grid) {
    PackedPage result;
    result.positions.reserve(page.vertices.size());
    result.attributes.reserve(page.vertices.size());
    for (const PackedVertex& vertex : packedVertices(id, page, grid)) {
        result.positions.push_back(vertex.position);
        result.attributes.push_back({vertex.normal, vertex.color});
    }
    result.indices = packedIndices(page);
    return result;
}

template <class T>
void fill(const gl::RingPiece& piece, const std::vector<T>& values) {
    std::memcpy(piece.bytes.data(), values.data(), piece.bytes.size());
}

/// Encodes a stored error in 8 bits: its logarithm relative to the grid step, in eighths of an octave, rounded up. Code
/// 0 means no error.
std::uint32_t errorCode(double error, double step) {
    if (!(error > 0)) return 0;
    const double code = std::ceil(8 * std::log2(error / step)) + 9;
    return static_cast<std::uint32_t>(std::clamp(code, 1.0, 255.0));
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

std::vector<std::uint16_t> packedIndices(const hierarchy::Page& page) {
    std::vector<Index> indices;
    indices.reserve(page.triangles.size() * 3);
    for (const hierarchy::Cluster& cluster : page.clusters) {
        const std::uint32_t first = cluster.firstVertex - indexBase(cluster);
        for (std::uint32_t t = 0; t < cluster.triangleCount; ++t)
            for (const std::uint8_t corner : page.triangles[cluster.firstTriangle + t])
                indices.push_back(static_cast<Index>(first + corner));
    }
    return indices;
}

GeometryPool::GeometryPool(const gl::Api& api, gl::MappedRing& staging, Bytes cap)
    : api_(&api), staging_(&staging), cap_(cap) {}

Bytes GeometryPool::size() const {
    Bytes sum;
    for (const Chunk& chunk : chunks_)
        sum.count += chunk.buffer.size();
    return sum;
}

GeometryPool::PageOffsets GeometryPool::Chunk::offsets(const PagePlace& place) const {
    const auto vertex = static_cast<std::size_t>(place.baseVertex);
    return {
        vertex * kPositionBytes,
        vertexCapacity * kPositionBytes + vertex * sizeof(PackedAttributes),
        std::size_t{place.firstIndex} * sizeof(Index)};
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

/// Adds a GL buffer to the pool. Its memory is divided between vertices and indices in the same ratio as in `page`.
bool GeometryPool::addChunk(const PageSize& page) {
    const std::uint64_t held = size().count;
    const std::uint64_t left = cap_.count - std::min(cap_.count, held);
    const std::uint64_t needed = page.vertices * kVertexBytes + page.indices * sizeof(Index);
    const std::uint64_t wanted = std::max({std::clamp(held, kMinChunk.count, kMaxChunk.count), needed});
    const std::uint64_t bytes = std::min(wanted, left);
    if (bytes < needed) return false;
    const double pages = static_cast<double>(bytes) / static_cast<double>(needed);
    const std::uint64_t vertices = std::min(
        (bytes - page.indices * sizeof(Index)) / kVertexBytes,
        std::max<std::uint64_t>(page.vertices, static_cast<std::uint64_t>(pages * static_cast<double>(page.vertices))));
    const std::uint64_t indices = (bytes - vertices * kVertexBytes) / sizeof(Index);
    Chunk chunk;
    chunk.buffer = gl::Buffer(*api_, vertices * kVertexBytes + indices * sizeof(Index));
    const std::array<gl::VertexStream, 2> streams = {
        gl::VertexStream{0, static_cast<GLsizei>(kPositionBytes)},
        gl::VertexStream{vertices * kPositionBytes, static_cast<GLsizei>(sizeof(PackedAttributes))}};
    chunk.positions =
        gl::VertexArray(*api_, chunk.buffer, std::span(streams).first(1), std::span(kAttributes).first(1));
    chunk.surfaces = gl::VertexArray(*api_, chunk.buffer, streams, kAttributes);
    chunk.vertexCapacity = vertices;
    chunk.vertices = FreeList(vertices);
    chunk.indices = FreeList(indices);
    chunks_.push_back(std::move(chunk));
    return true;
}

std::optional<PagePlace> GeometryPool::place(const PageSize& page) {
    for (std::size_t c = 0; c < chunks_.size(); ++c) {
        Chunk& chunk = chunks_[c];
        const auto vertex = chunk.vertices.take(page.vertices);
        if (!vertex) continue;
        const auto index = chunk.indices.take(page.indices);
        if (!index) {
            chunk.vertices.release(*vertex, page.vertices);
            continue;
        }
        const std::size_t indexStart = chunk.vertexCapacity * (kVertexBytes / sizeof(Index));
        return PagePlace{c, static_cast<GLint>(*vertex), static_cast<GLuint>(indexStart + *index)};
    }
    if (!addChunk(page)) return std::nullopt;
    return place(page);
}

void GeometryPool::upload(const gl::Buffer& buffer, std::size_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const gl::RingPiece piece = staging_->take(std::min(bytes.size(), staging_->segmentBytes()));
        std::copy_n(bytes.begin(), piece.bytes.size(), piece.bytes.begin());
        buffer.copy(offset, staging_->id(), piece.offset, piece.bytes.size());
        offset += piece.bytes.size();
        bytes = bytes.subspan(piece.bytes.size());
    }
}

std::optional<PagePlace> GeometryPool::insert(
    std::uint32_t id, const hierarchy::Page& page, const hierarchy::Grid& grid) {
    const PageSize pageSize{page.vertices.size(), page.triangles.size() * 3};
    const auto found = place(pageSize);
    if (!found && entries_.empty())
        throw LimitError(
            Limit::DrawingMemory,
            {"drawing memory",
             "too small for a page of the model",
             readableBytes({pageSize.vertices * kVertexBytes + pageSize.indices * sizeof(Index)}),
             readableBytes(cap_)});
    if (!found) return std::nullopt;
    const PackedPage bytes = packed(id, page, grid);
    const Chunk& chunk = chunks_[found->chunk];
    const PageOffsets offsets = chunk.offsets(*found);
    upload(chunk.buffer, offsets.positions, std::as_bytes(std::span(bytes.positions)));
    upload(chunk.buffer, offsets.attributes, std::as_bytes(std::span(bytes.attributes)));
    upload(chunk.buffer, offsets.indices, std::as_bytes(std::span(bytes.indices)));
    remember(id, *found, pageSize);
    return found;
}

void GeometryPool::insertAll(std::span<const NewPage> pages, const hierarchy::Grid& grid) {
    std::vector<Staged> staged;
    // Used staging memory in bytes, at most one segment. If a segment is full, its copy commands are issued.
    std::size_t bytes = 0;
    const auto flush = [&] {
        upload(staged, grid);
        staged.clear();
        bytes = 0;
    };
    for (const NewPage& page : pages) {
        Staged next{page, {}, {page.page->vertices.size(), page.page->triangles.size() * 3}, {}, {}, {}};
        const std::array<std::size_t, 3> sizes = {
            next.size.vertices * kPositionBytes,
            next.size.vertices * sizeof(PackedAttributes),
            next.size.indices * sizeof(Index)};
        std::size_t needed = 0;
        for (const std::size_t size : sizes)
            needed += gl::MappedRing::aligned(size);
        if (needed > staging_->segmentBytes()) continue; // `insert` uploads such a page in parts
        const auto found = place(next.size);
        if (!found) break;
        if (bytes + needed > staging_->segmentBytes()) flush();
        bytes += needed;
        next.place = *found;
        next.positions = staging_->take(sizes[0]);
        next.attributes = staging_->take(sizes[1]);
        next.indices = staging_->take(sizes[2]);
        staged.push_back(next);
    }
    flush();
}

void GeometryPool::upload(std::span<const Staged> pages, const hierarchy::Grid& grid) {
    tbb::parallel_for(std::size_t{0}, pages.size(), [&](std::size_t i) {
        const PackedPage bytes = packed(pages[i].page.id, *pages[i].page.page, grid);
        fill(pages[i].positions, bytes.positions);
        fill(pages[i].attributes, bytes.attributes);
        fill(pages[i].indices, bytes.indices);
    });
    for (const Staged& page : pages) {
        const Chunk& chunk = chunks_[page.place.chunk];
        const PageOffsets offsets = chunk.offsets(page.place);
        const auto copy = [&](std::size_t offset, const gl::RingPiece& piece) {
            chunk.buffer.copy(offset, staging_->id(), piece.offset, piece.bytes.size());
        };
        copy(offsets.positions, page.positions);
        copy(offsets.attributes, page.attributes);
        copy(offsets.indices, page.indices);
        remember(page.page.id, page.place, page.size);
    }
}

void GeometryPool::remember(std::uint32_t id, const PagePlace& place, const PageSize& size) {
    byUse_.push_front({id, place, size});
    entries_.emplace(id, byUse_.begin());
}

bool GeometryPool::evictOldest() {
    if (byUse_.empty()) return false;
    const Entry& oldest = byUse_.back();
    Chunk& chunk = chunks_[oldest.place.chunk];
    chunk.vertices.release(static_cast<std::size_t>(oldest.place.baseVertex), oldest.size.vertices);
    chunk.indices.release(
        oldest.place.firstIndex - chunk.vertexCapacity * (kVertexBytes / sizeof(Index)), oldest.size.indices);
    entries_.erase(oldest.id);
    byUse_.pop_back();
    return true;
}

} // namespace gnomon::render
