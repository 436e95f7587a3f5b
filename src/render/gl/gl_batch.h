// The draw calls of one OpenGL pass. They are collected per GL buffer and issued together.
#pragma once

#include "gl/api.h"
#include "gl/mapped_ring.h"
#include "lod/cut.h"
#include "render/gl/geometry_pool.h"

#include <vector>

namespace gnomon::render {

/// The parameters of one indirect draw, in the layout of OpenGL 4.5, section 10.3.10.
struct DrawCommand {
    GLuint count = 0;
    GLuint instanceCount = 1;
    GLuint firstIndex = 0;
    GLint baseVertex = 0;
    GLuint baseInstance = 0;
};

/// Appends the indirect draws of the clusters `range` of `page` to `commands`. The page is at `place` in the geometry
/// pool. Clusters with different base vertices (`indexBase`) need separate draws.
void appendCommands(
    std::vector<DrawCommand>& commands,
    const PagePlace& place,
    const hierarchy::Page& page,
    const lod::ClusterRange& range);

class GlBatch {
public:
    /// Creates an empty batch of draws. `withAttributes` is true for drawing surfaces, and false for drawing only
    /// depth. `commands` is the ring buffer to which the draws are written.
    GlBatch(const gl::Api& api, gl::MappedRing& commands, bool withAttributes)
        : api_(&api), commands_(&commands), withAttributes_(withAttributes) {}

    /// Adds the draws of the clusters `range` of `page`. The page is at `place` in the geometry pool.
    void add(const PagePlace& place, const hierarchy::Page& page, const lod::ClusterRange& range);

    /// Issues all collected draws and returns their number. Each GL buffer needs one indirect call, or more calls if
    /// the ring buffer is too small. If `waits` is true, the function waits for each call before it issues the next
    /// call.
    std::uint64_t flush(const GeometryPool& pool, bool waits);

private:
    const gl::Api* api_;
    gl::MappedRing* commands_;
    bool withAttributes_;
    std::vector<std::vector<DrawCommand>> draws_; // one list per chunk
};

} // namespace gnomon::render
