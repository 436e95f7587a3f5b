#include "lod/frame_cut.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <vector>

namespace gnomon::lod {
namespace {

/// Number of pages per task. A task takes tens of microseconds, so the overhead of scheduling is small.
constexpr std::size_t kPagesPerTask = 24;

} // namespace

lod::Cut cutFrame(const lod::CutQuery& query) {
    std::vector<std::uint32_t> missingRoots;
    const std::vector<lod::PageVisit> visits = lod::visitedPages(query, missingRoots);
    const std::size_t taskCount = (visits.size() + kPagesPerTask - 1) / kPagesPerTask;
    std::vector<lod::CutPart> parts(taskCount, lod::CutPart(query));
    tbb::parallel_for(std::size_t{0}, taskCount, [&](std::size_t task) {
        const std::size_t end = std::min(visits.size(), (task + 1) * kPagesPerTask);
        for (std::size_t i = task * kPagesPerTask; i < end; ++i)
            parts[task].add(visits[i]);
    });
    return lod::CutPart::joined(query, parts, missingRoots);
}

ConvexVolume localVolume(const ConvexVolume& volume, const lod::DetailView& view) {
    ConvexVolume result;
    result.planes.reserve(volume.planes.size());
    for (const Plane& plane : volume.planes) {
        const glm::dvec3 normal = toWorld(view.basis, plane.normal);
        result.planes.push_back({normal, plane.offset - glm::dot(normal, view.eye)});
    }
    return result;
}

} // namespace gnomon::lod
