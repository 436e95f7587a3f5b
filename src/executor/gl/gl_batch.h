// The draws of one pass of OpenGL, gathered by the pool's chunks and issued together.
#pragma once

#include "executor/gl/geometry_pool.h"
#include "gl/api.h"
#include "gl/mapped_ring.h"
#include "selection/cut.h"

#include <vector>

namespace gnomon::executor {

/// One draw, as OpenGL 4.5 lays it out (section 10.3.10).
struct DrawCommand {
    GLuint count = 0;
    GLuint instanceCount = 1;
    GLuint firstIndex = 0;
    GLint baseVertex = 0;
    GLuint baseInstance = 0;
};

/// Appends to `commands` the draws of a range of the clusters of `page`, which lies at `place`: one for each multiple
/// of vertices that its indices count from.
void appendCommands(
    std::vector<DrawCommand>& commands,
    const PagePlace& place,
    const hierarchy::Page& page,
    const selection::ClusterRange& range);

class GlBatch {
public:
    /// `withAttributes` for surfaces, not for depth alone. What is drawn is put into `commands`.
    GlBatch(const gl::Api& api, gl::MappedRing& commands, bool withAttributes)
        : api_(&api), commands_(&commands), withAttributes_(withAttributes) {}

    /// Adds a range of the clusters of `page`, which lies at `place` in the pool.
    void add(const PagePlace& place, const hierarchy::Page& page, const selection::ClusterRange& range);

    /// Issues what was added, by one indirect call a chunk as long as the ring has the room; returns how many ranges
    /// that draws. `waits` for each call before the next is queued.
    std::uint64_t flush(const GeometryPool& pool, bool waits);

private:
    const gl::Api* api_;
    gl::MappedRing* commands_;
    bool withAttributes_;
    std::vector<std::vector<DrawCommand>> draws_; // by chunk
};

} // namespace gnomon::executor
