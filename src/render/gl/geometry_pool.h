// A cache of decoded pages in GPU memory. A few large GL buffers of limited total size contain the positions,
// attributes and indices of all pages.
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

/// The location of a page in the geometry pool. A chunk is one GL buffer of the pool.
struct PagePlace {
    std::size_t chunk = 0;
    GLint baseVertex = 0;
    GLuint firstIndex = 0; // number of indices from the start of the chunk's buffer
};

/// Returns the base vertex of the draw call for `cluster`: the last multiple of 2^15 that is not above the cluster's
/// first vertex. Relative to this base, 16-bit indices are sufficient for pages of any size.
constexpr std::uint32_t indexBase(const hierarchy::Cluster& cluster) {
    constexpr std::uint32_t kBlock = 1U << 15U;
    return cluster.firstVertex / kBlock * kBlock;
}

/// A cache of pages in GPU memory that evicts the least recently used page. The cache consists of GL buffers called
/// chunks. A chunk contains first the positions of all vertices, which are sufficient for shadow maps, then their
/// attributes, and then indices.
class GeometryPool {
public:
    /// Creates a pool whose buffers never exceed `cap` in total. Buffers are created on demand. A new buffer is as
    /// large as all earlier buffers together, within limits. Pages are uploaded through the ring buffer `staging`.
    GeometryPool(const gl::Api& api, gl::MappedRing& staging, Bytes cap);

    /// Changes the size limit of the pool to `cap`, and immediately evicts pages until the pool is small enough. The
    /// caller must have issued all draw calls that use these pages.
    void keepUnder(Bytes cap);

    /// Returns the location of `page` in the pool, and marks it as recently used. Returns nullopt if the page is not in
    /// the pool.
    std::optional<PagePlace> find(std::uint32_t page);

    /// A page to insert into the pool.
    struct NewPage {
        std::uint32_t id = 0;
        const hierarchy::Page* page = nullptr;
    };

    /// Inserts `pages` in order, until a page needs an eviction. The pages must be distinct and not in the pool. All
    /// worker threads write to the staging memory, one segment at a time.
    void insertAll(std::span<const NewPage> pages, const hierarchy::Grid& grid);

    /// Inserts `page`. Returns nullopt if the pool has no free memory for the page. The caller must then call
    /// `evictOldest`. Throws Error if the page alone exceeds the size limit.
    std::optional<PagePlace> insert(std::uint32_t id, const hierarchy::Page& page, const hierarchy::Grid& grid);

    /// Evicts the least recently used page. Returns false if the pool is empty. The caller must have issued all draw
    /// calls that use this page.
    bool evictOldest();

    /// Returns the OpenGL vertex array of GL buffer `chunk`. The array contains positions and attributes if
    /// `withAttributes` is true, otherwise positions only.
    GLuint vertexArray(std::size_t chunk, bool withAttributes) const {
        return (withAttributes ? chunks_[chunk].surfaces : chunks_[chunk].positions).id();
    }

    std::size_t chunkCount() const { return chunks_.size(); }

    /// Returns the total size of all GL buffers of the pool.
    Bytes size() const;

private:
    struct PageSize {
        std::size_t vertices = 0;
        std::size_t indices = 0;
    };

    /// Byte offsets of a page's positions, attributes and indices in the GL buffer.
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

    /// A page during its upload: its location in the pool and its ranges of staging memory.
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

/// A vertex in the layout of the shaders. Two fields differ from the stored vertex. The top bits of the position
/// contain the three bits of the cluster's colour index. The alpha of the colour contains the cluster's error, rounded
/// up.
using PackedVertex = hierarchy::Vertex;

/// Converts the vertices of `page` to the layout of the shaders. `page` must be valid.
std::vector<PackedVertex> packedVertices(std::uint32_t id, const hierarchy::Page& page, const hierarchy::Grid& grid);

/// Returns the vertex indices of `page` for the GPU, three per triangle. The indices of a cluster are relative to
/// `indexBase` of the cluster.
std::vector<std::uint16_t> packedIndices(const hierarchy::Page& page);

/// Returns the error of `cluster` compared with the source mesh, in world units. On level 0, this is the error by
/// rounding vertices to the grid. On other levels, it is the stored error of the finer group that the cluster replaces.
double storedError(const hierarchy::Page& page, const hierarchy::Cluster& cluster, const hierarchy::Grid& grid);

} // namespace gnomon::render
