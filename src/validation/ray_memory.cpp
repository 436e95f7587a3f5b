#include "validation/ray_memory.h"

#include "core/error.h"
#include "core/limit_error.h"
#include "frame/frame_cuts.h"
#include "render/ray_shadows.h"

#include <vector>

namespace gnomon::validation {

namespace {

constexpr const char* kWhere = "the full oracle";

bool isWhole(const frame::PreparedFrame& frame) {
    return frame.cut.wanted.empty() && frame.residency.pagesMissing == 0;
}

/// Returns the number of triangles that rays can hit in `frame`, whose pages must all be in memory.
std::uint64_t triangleCount(const frame::Renderer& renderer, const frame::PreparedFrame& frame) {
    const hierarchy::ResidentPages resident = renderer.residency().resident();
    std::uint64_t triangles = 0;
    for (const lod::ClusterRange& cluster : render::distinctClusters(listsOf(frame)))
        triangles += resident[cluster.page]->clusters[cluster.firstCluster].triangleCount;
    return triangles;
}

/// Returns the number of triangles of level 0 in `pages`.
std::uint64_t finestTriangles(const frame::Renderer& renderer, std::span<const std::uint32_t> pages) {
    std::uint64_t triangles = 0;
    for (const std::uint32_t page : pages) {
        const hierarchy::PageInfo& info = renderer.model().pages()[page];
        triangles += info.level == 0 ? info.triangleCount : 0;
    }
    return triangles;
}

/// Rounds `bytes` up to whole mebibytes, so that the printed memory is sufficient.
std::uint64_t wholeMebibytes(Bytes bytes) {
    return (bytes.count + mebibytes(1).count - 1) / mebibytes(1).count;
}

} // namespace

std::vector<const lod::DrawList*> listsOf(const frame::PreparedFrame& frame) {
    return frame.cut.lists.all();
}

MemoryWithRays memoryWithRays(const frame::Renderer& renderer, const frame::PreparedFrame& fine) {
    const frame::Residency& residency = renderer.residency();
    const std::vector<std::uint32_t> pages = residency.pagesOf(frame::cutQuery(residency, fine), fine.cut);
    if (fine.isRayTraced()) return {residency.bytesWith(pages), residency.rayTreeBytesWith(pages)};
    const std::uint64_t triangles = isWhole(fine) ? triangleCount(renderer, fine) : finestTriangles(renderer, pages);
    return {residency.bytesWith(pages), {triangles * raytrace::kSceneBytesPerTriangle.count}};
}

RayMemory::RayMemory(frame::Renderer& renderer, const frame::PreparedFrame& fine) : residency_(&renderer.residency()) {
    if (fine.residency.pagesBlocked > 0)
        throw Error(
            kWhere,
            "the finest level of this view is damaged",
            "all its pages",
            std::to_string(fine.residency.pagesBlocked) + " that cannot be read");
    const MemoryWithRays needed = memoryWithRays(renderer, fine);
    if (!isWhole(fine) || needed.all() > residency_->memory())
        throw LimitError(
            Limit::PageMemory,
            {kWhere,
             "the finest level of this view and rays against it take more than the page memory",
             "at least " + std::to_string(wholeMebibytes(needed.all())) + "M",
             readableBytes(residency_->memory())});
    // A ray-traced frame has already reserved the memory of its trees, together with its pages.
    if (!fine.isRayTraced()) residency_->reserve(needed.rays);
}

RayMemory::~RayMemory() {
    residency_->reserve({0});
}

} // namespace gnomon::validation
