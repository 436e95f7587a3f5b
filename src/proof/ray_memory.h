// The memory of rays against the finest level: counted beside the pages, in what --memory allows for both.
#pragma once

#include "frame/renderer.h"

#include <vector>

namespace gnomon::proof {

/// What a frame of the finest level takes.
struct MemoryWithRays {
    Bytes pages; // with the tables
    Bytes rays;  // a scene of all its triangles, or the trees that are kept beside its pages

    Bytes all() const { return {pages.count + rays.count}; }
};

/// All that rays of `frame` can meet: the image's list, and the casters' where anything faces the light.
std::vector<const selection::DrawList*> listsOf(const frame::PreparedFrame& frame);

/// What `fine` takes, which `renderer` has just prepared: exactly if all its pages are resident, else no less than
/// that.
MemoryWithRays memoryWithRays(const frame::Renderer& renderer, const frame::PreparedFrame& fine);

/// Room for the scene of a frame beside its pages, as long as this lives.
class RayMemory {
public:
    /// Throws Error if pages of `fine`, which `renderer` has just prepared, are damaged, or if the memory does not hold
    /// it and its scene; names what does.
    RayMemory(frame::Renderer& renderer, const frame::PreparedFrame& fine);
    ~RayMemory();
    RayMemory(const RayMemory&) = delete;
    RayMemory& operator=(const RayMemory&) = delete;
    RayMemory(RayMemory&&) = delete;
    RayMemory& operator=(RayMemory&&) = delete;

private:
    frame::Residency* residency_;
};

} // namespace gnomon::proof
