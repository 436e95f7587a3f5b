// The memory for rays against the finest level. It counts, like the pages, towards --memory.
#pragma once

#include "frame/renderer.h"

#include <vector>

namespace gnomon::validation {

/// The memory that a frame of the finest level needs.
struct MemoryWithRays {
    Bytes pages; // including the tables
    Bytes rays;  // a scene of all triangles, or the trees that are stored next to their pages

    Bytes all() const { return {pages.count + rays.count}; }
};

/// Returns all draw lists that rays of `frame` can hit: the list of the image, and that of the casters if a surface
/// faces the light.
std::vector<const lod::DrawList*> listsOf(const frame::PreparedFrame& frame);

/// Returns the memory for `fine`, which `renderer` has just prepared. The result is exact if all its pages are
/// resident, otherwise a lower bound.
MemoryWithRays memoryWithRays(const frame::Renderer& renderer, const frame::PreparedFrame& fine);

/// A reservation of memory for the scene of a frame, next to its pages.
class RayMemory {
public:
    /// Reserves the memory for `fine`, which `renderer` has just prepared. Throws Error if pages are damaged, or if the
    /// memory is too small. The message then says how much is needed.
    RayMemory(frame::Renderer& renderer, const frame::PreparedFrame& fine);
    ~RayMemory();
    RayMemory(const RayMemory&) = delete;
    RayMemory& operator=(const RayMemory&) = delete;
    RayMemory(RayMemory&&) = delete;
    RayMemory& operator=(RayMemory&&) = delete;

private:
    frame::Residency* residency_;
};

} // namespace gnomon::validation
