// A cache of pages in GL memory. The positions, attributes and indices of all pages are in a few large buffers, whose
// total size is limited.
#pragma once

#include "core/units.h"
#include "gl/mapped_ring.h"
#include "gl/objects.h"
#include "hierarchy/grid.h"
#include "hierarchy/page.h"
#include "render/gl/free_list.h"

#include <cstdint>
#include <list>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace gnomon::render {

/// The place of a page in the pool. A chunk is one GL buffer of the pool.
struct PagePlace {
    std::size_t chunk = 0;
    GLint baseVertex = 0;
    GLuint firstIndex = 0; // number of indices from the start of the chunk's buffer
};

/// Returns the base vertex for the indices of `cluster`: the last multiple of 2^15 that is not above the cluster's
/// first vertex. Relative to it, 16-bit indices are sufficient for pages of any size.
constexpr std::uint32_t indexBase(const hierarchy::Cluster& cluster) {
    constexpr std::uint32_t kBlock = 1U << 15U;
    return cluster.firstVertex / kBlock * kBlock;
}

/// A cache of pages in GL memory that evicts the least recently used page. A chunk is one GL buffer. It contains first
/// the positions of all vertices, which are sufficient for shadow maps, then their attributes, and then indices.
class GeometryPool {
public:
    /// Creates a pool whose buffers never exceed `cap`. Buffers are created on demand. Within limits, a new buffer is
    /// as large as all earlier buffers together. Pages are uploaded through the ring buffer `staging`.
    GeometryPool(const gl::Api& api, gl::MappedRing& staging, Bytes cap);

    /// Changes the limit of the pool, and immediately evicts pages until the limit is met. The caller must have issued
    /// all draws with these pages.
    void keepUnder(Bytes cap);

    /// Returns the place of `page` if it is in the pool, and marks it as used.
    std::optional<PagePlace> find(std::uint32_t page);

    /// A page to insert.
    struct NewPage {
        std::uint32_t id = 0;
        const hierarchy::Page* page = nullptr;
    };

    /// Inserts pages of `pages` in order, as far as they fit without eviction. The pages must be distinct and not in
    /// the pool. All worker threads write to the staging memory, one segment at a time.
    void insertAll(std::span<const NewPage> pages, const hierarchy::Grid& grid);

    /// Inserts `page`. Returns nullopt if the pool has no free memory for the page; the caller then calls
    /// `evictOldest`. Throws Error if the page alone exceeds the limit.
    std::optional<PagePlace> insert(std::uint32_t id, const hierarchy::Page& page, const hierarchy::Grid& grid);

    /// Evicts the least recently used page. Returns false if the pool is empty. The caller must have issued all draws
    /// with this page.
    bool evictOldest();

    /// Returns the vertex array object of a chunk, with positions and attributes, or with positions only.
    GLuint vertexArray(std::size_t chunk, bool withAttributes) const {
        return (withAttributes ? chunks_[chunk].surfaces : chunks_[chunk].positions).id();
    }

    std::size_t chunkCount() const { return chunks_.size(); }

    /// Returns the total size of all buffers.
    Bytes size() const;

private:
    struct PageSize {
        std::size_t vertices = 0;
        std::size_t indices = 0;
    };

    /// The byte offsets of the parts of a page in the buffer of its chunk.
    struct PageOffsets {
        std::size_t positions = 0;
        std::size_t attributes = 0;
        std::size_t indices = 0;
    };

    struct Chunk {
        PageOffsets offsets(const PagePlace& place) const;

        gl::Buffer buffer;
        gl::VertexArray positions;
        gl::VertexArray surfaces;
        std::size_t vertexCapacity = 0;
        FreeList vertices;
        FreeList indices;
    };

    struct Entry {
        std::uint32_t id = 0;
        PagePlace place;
        PageSize size;
    };

    /// A page with its place in the pool and its ranges of staging memory.
    struct Staged {
        NewPage page;
        PagePlace place;
        PageSize size;
        gl::RingPiece positions;
        gl::RingPiece attributes;
        gl::RingPiece indices;
    };

    std::optional<PagePlace> place(const PageSize& page);
    void upload(std::span<const Staged> pages, const hierarchy::Grid& grid);
    void remember(std::uint32_t id, const PagePlace& place, const PageSize& size);
    bool addChunk(const PageSize& page);
    void upload(const gl::Buffer& buffer, std::size_t offset, std::span<const std::byte> bytes);

    const gl::Api* api_;
    gl::MappedRing* staging_;
    Bytes cap_;
    std::vector<Chunk> chunks_;
    std::list<Entry> byUse_; // most recently used first
    std::unordered_map<std::uint32_t, std::list<Entry>::iterator> entries_;
};

/// A vertex in the layout of the shaders. Two fields differ from the vertex of the page. The top bits of the position
/// store the three bits of the cluster's colour index. The alpha of the colour stores the cluster's stored error,
/// rounded up.
using PackedVertex = hierarchy::Vertex;

/// Returns the vertices of `page` for the GPU. `page` must be valid.
std::vector<PackedVertex> packedVertices(std::uint32_t id, const hierarchy::Page& page, const hierarchy::Grid& grid);

/// Returns the indices of `page` for the GPU, three per triangle. Indices are relative to the result of `indexBase` for
/// their cluster.
std::vector<std::uint16_t> packedIndices(const hierarchy::Page& page);

/// Returns the error of a cluster compared with the source, in world units: the stored error of its refinement, or on
/// level 0 the error by snapping to the grid.
double storedError(const hierarchy::Page& page, const hierarchy::Cluster& cluster, const hierarchy::Grid& grid);

} // namespace gnomon::render
