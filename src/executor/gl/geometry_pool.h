// Pages as GL sees them: vertices and indices of every page in few large buffers under one cap of bytes.
#pragma once

#include "core/units.h"
#include "executor/gl/free_list.h"
#include "gl/objects.h"
#include "hierarchy/grid.h"
#include "hierarchy/page.h"

#include <cstdint>
#include <list>
#include <optional>
#include <unordered_map>
#include <vector>

namespace gnomon::executor {

/// Where a page lies.
struct PagePlace {
    std::size_t chunk = 0;
    GLint baseVertex = 0;
    std::size_t indexOffset = 0; // bytes from the start of the chunk's buffer
};

/// A cache of pages in GL buffers. Pages leave it oldest use first.
class GeometryPool {
public:
    /// Never holds more than its cap in buffers; buffers are made as they are needed.
    GeometryPool(const gl::Api& api, Bytes cap);

    /// Changes the cap; what no longer fits goes at once. Draws of it must have been issued.
    void keepUnder(Bytes cap);

    /// The place of `page` if it is there; counts as a use.
    std::optional<PagePlace> find(std::uint32_t page);

    /// Puts `page` in; nothing if that needs room that only `evictOldest` can make. Throws Error if the page alone is
    /// larger than the cap.
    std::optional<PagePlace> insert(std::uint32_t id, const hierarchy::Page& page, const hierarchy::Grid& grid);

    /// Drops the page that was not used for longest; false if there is none. Draws of it must have been issued.
    bool evictOldest();

    /// The vertex array over a chunk's buffer.
    GLuint vertexArray(std::size_t chunk) const { return chunks_[chunk].vertices.id(); }

    std::size_t chunkCount() const { return chunks_.size(); }

    /// What the buffers take.
    Bytes size() const;

private:
    struct Chunk {
        gl::Buffer buffer;
        gl::VertexArray vertices;
        FreeList space; // in units of one vertex
    };

    struct Entry {
        std::uint32_t id = 0;
        PagePlace place;
        std::size_t units = 0;
    };

    std::optional<PagePlace> place(std::size_t vertexCount, std::size_t units);
    bool addChunk(std::size_t units);

    const gl::Api* api_;
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

/// The error of drawing a cluster instead of the source: its refinement's, or the snap error at level 0; world units.
double storedError(const hierarchy::Page& page, const hierarchy::Cluster& cluster, const hierarchy::Grid& grid);

} // namespace gnomon::executor
