// The draws of one OpenGL pass, collected per chunk (GL buffer) of the geometry pool and issued together.
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

/// Appends the draws of a range of clusters of `page` to `commands`. The page is at `place` in the geometry pool.
/// Clusters with different base vertices (`indexBase`) need separate draws.
void appendCommands(
    std::vector<DrawCommand>& commands,
    const PagePlace& place,
    const hierarchy::Page& page,
    const lod::ClusterRange& range);

class GlBatch {
public:
    /// Creates an empty batch. `withAttributes` is true for drawing surfaces, and false for drawing only depth. The
    /// draw commands are written to the ring `commands`.
    GlBatch(const gl::Api& api, gl::MappedRing& commands, bool withAttributes)
        : api_(&api), commands_(&commands), withAttributes_(withAttributes) {}

    /// Adds a range of clusters of `page`, which is at `place` in the geometry pool.
    void add(const PagePlace& place, const hierarchy::Page& page, const lod::ClusterRange& range);

    /// Issues all draws with one indirect call per chunk, or with more calls if the ring is too small. Returns the
    /// number of draws. If `waits`, the function waits for each call before it issues the next call.
    std::uint64_t flush(const GeometryPool& pool, bool waits);

private:
    const gl::Api* api_;
    gl::MappedRing* commands_;
    bool withAttributes_;
    std::vector<std::vector<DrawCommand>> draws_; // one list per chunk
};

} // namespace gnomon::render
