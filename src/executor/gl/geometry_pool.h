// Pages as GL sees them: positions, attributes and indices of every page in few large buffers under one cap of bytes.
#pragma once

#include "core/units.h"
#include "executor/gl/free_list.h"
#include "gl/mapped_ring.h"
#include "gl/objects.h"
#include "hierarchy/grid.h"
#include "hierarchy/page.h"

#include <cstdint>
#include <list>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace gnomon::executor {

/// Where a page lies.
struct PagePlace {
    std::size_t chunk = 0;
    GLint baseVertex = 0;
    GLuint firstIndex = 0; // in indices from the start of the chunk's buffer
};

/// An index counts from a multiple of this many vertices of its page, the last before its cluster's first: so that 16
/// bits do, for pages of any size. This is that multiple.
constexpr std::uint32_t indexBase(const hierarchy::Cluster& cluster) {
    constexpr std::uint32_t kBlock = 1U << 15U;
    return cluster.firstVertex / kBlock * kBlock;
}

/// A cache of pages in GL buffers. Pages leave it oldest use first. A chunk is one buffer: positions of all its
/// vertices, which is all that shadow maps read, then their attributes, then indices.
class GeometryPool {
public:
    /// Never holds more than its cap in buffers; buffers are made as they are needed, each as large as those before it
    /// together, within bounds. Pages come in through `staging`.
    GeometryPool(const gl::Api& api, gl::MappedRing& staging, Bytes cap);

    /// Changes the cap; what no longer fits goes at once. Draws of it must have been issued.
    void keepUnder(Bytes cap);

    /// The place of `page` if it is there; counts as a use.
    std::optional<PagePlace> find(std::uint32_t page);

    /// A page to be put in.
    struct NewPage {
        std::uint32_t id = 0;
        const hierarchy::Page* page = nullptr;
    };

    /// Puts in those of `pages`, all different and none of them there, that there is room for without dropping others.
    /// All worker threads write to the staging memory, as many pages at a time as a segment of it holds.
    void insertAll(std::span<const NewPage> pages, const hierarchy::Grid& grid);

    /// Puts `page` in; nothing if that needs room that only `evictOldest` can make. Throws Error if the page alone is
    /// larger than the cap.
    std::optional<PagePlace> insert(std::uint32_t id, const hierarchy::Page& page, const hierarchy::Grid& grid);

    /// Drops the page that was not used for longest; false if there is none. Draws of it must have been issued.
    bool evictOldest();

    /// The vertex array over a chunk's buffer, of positions with attributes or alone.
    GLuint vertexArray(std::size_t chunk, bool withAttributes) const {
        return (withAttributes ? chunks_[chunk].surfaces : chunks_[chunk].positions).id();
    }

    std::size_t chunkCount() const { return chunks_.size(); }

    /// What the buffers take.
    Bytes size() const;

private:
    struct PageSize {
        std::size_t vertices = 0;
        std::size_t indices = 0;
    };

    /// Where what a page consists of begins in its chunk's buffer, in bytes.
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

    /// A page that has a place and pieces of the staging memory.
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
    std::list<Entry> byUse_; // newest first
    std::unordered_map<std::uint32_t, std::list<Entry>::iterator> entries_;
};

/// A vertex as the shaders read it: the page's own, but the top bits of the position carry three bits that tell
/// clusters apart and the colour's alpha the cluster's stored error, rounded up.
using PackedVertex = hierarchy::Vertex;

/// The vertices of `page` for the GPU; `page` must hold what the reader validates.
std::vector<PackedVertex> packedVertices(std::uint32_t id, const hierarchy::Page& page, const hierarchy::Grid& grid);

/// The indices of `page` for the GPU, by triangle; each counts from its cluster's `indexBase`.
std::vector<std::uint16_t> packedIndices(const hierarchy::Page& page);

/// The error of drawing a cluster instead of the source: its refinement's, or the snap error at level 0; world units.
double storedError(const hierarchy::Page& page, const hierarchy::Cluster& cluster, const hierarchy::Grid& grid);

} // namespace gnomon::executor
