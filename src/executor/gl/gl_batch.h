// The draws of one pass of OpenGL, gathered by the pool's chunks and issued together.
#pragma once

#include "executor/gl/geometry_pool.h"
#include "gl/api.h"
#include "selection/cut.h"

#include <vector>

namespace gnomon::executor {

class GlBatch {
public:
    explicit GlBatch(const gl::Api& api) : api_(&api) {}

    /// Adds a range of the clusters of `page`, which lies at `place` in the pool.
    void add(const PagePlace& place, const hierarchy::Page& page, const selection::ClusterRange& range);

    /// Issues what was added; returns how many draw calls that took. `waits` for each chunk before the next is queued.
    std::uint64_t flush(const GeometryPool& pool, bool waits);

private:
    struct Draws {
        std::vector<GLsizei> counts;
        std::vector<const void*> offsets;
        std::vector<GLint> bases;
    };

    const gl::Api* api_;
    std::vector<Draws> draws_; // by chunk
};

} // namespace gnomon::executor
