// The draws of one OpenGL pass, collected per chunk of the pool and issued together.
#pragma once

#include "gl/api.h"
#include "gl/mapped_ring.h"
#include "lod/cut.h"
#include "render/gl/geometry_pool.h"

#include <vector>

namespace gnomon::render {

/// One indirect draw in the layout of OpenGL 4.5, section 10.3.10.
struct DrawCommand {
    GLuint count = 0;
    GLuint instanceCount = 1;
    GLuint firstIndex = 0;
    GLint baseVertex = 0;
    GLuint baseInstance = 0;
};

/// Appends the draws of a range of clusters of `page`, which is at `place`. Each base vertex of the indices gets its
/// own draw.
void appendCommands(
    std::vector<DrawCommand>& commands,
    const PagePlace& place,
    const hierarchy::Page& page,
    const lod::ClusterRange& range);

class GlBatch {
public:
    /// Makes an empty batch. `withAttributes` is true for surfaces and false for depth only. The draw commands go to
    /// the ring `commands`.
    GlBatch(const gl::Api& api, gl::MappedRing& commands, bool withAttributes)
        : api_(&api), commands_(&commands), withAttributes_(withAttributes) {}

    /// Adds a range of clusters of `page`, which is at `place` in the pool.
    void add(const PagePlace& place, const hierarchy::Page& page, const lod::ClusterRange& range);

    /// Issues all draws with one indirect call per chunk, or more if the ring is too small. Returns the number of
    /// draws. `waits` makes it wait for each call before the next one.
    std::uint64_t flush(const GeometryPool& pool, bool waits);

private:
    const gl::Api* api_;
    gl::MappedRing* commands_;
    bool withAttributes_;
    std::vector<std::vector<DrawCommand>> draws_; // one list per chunk
};

} // namespace gnomon::render
