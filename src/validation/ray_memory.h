// Computes and reserves the memory for tracing rays against the finest level of detail. Like the memory of pages, it
// counts towards --memory.
#pragma once

#include "frame/renderer.h"

#include <vector>

namespace gnomon::validation {

/// The memory that a frame at the finest level of detail needs for pages and ray tracing.
struct MemoryWithRays {
    Bytes pages; // pages and page tables
    Bytes rays;  // a scene of all triangles, or the ray-tracing trees of the pages

    Bytes all() const { return {pages.count + rays.count}; }
};

/// Returns all lists of drawn clusters that rays of `frame` can hit: the list of the image and, if a surface faces the
/// light, the list of the casters.
std::vector<const lod::DrawList*> listsOf(const frame::PreparedFrame& frame);

/// Returns the memory that ray tracing the frame `fine` needs. `renderer` must have prepared `fine` just before. The
/// result is exact if all pages are in memory, otherwise it is a lower bound.
MemoryWithRays memoryWithRays(const frame::Renderer& renderer, const frame::PreparedFrame& fine);

/// Reserves memory for the ray-tracing scene of a frame, in addition to its pages, until it is destroyed.
class RayMemory {
public:
    /// Reserves the memory for ray tracing the frame `fine`, which `renderer` must have prepared just before. Throws
    /// Error if pages are damaged, or if the memory is too small. The message then contains the required memory.
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
