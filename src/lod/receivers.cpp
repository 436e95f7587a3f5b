#include "lod/receivers.h"

#include "lod/triangle_clip.h"

#include <algorithm>
#include <limits>

namespace gnomon::lod {
namespace {

/// Calls `visit(page id, page, cluster index)` for each cluster of `list`.
template <class Visit>
void forEachCluster(const lod::CutQuery& query, const lod::DrawList& list, const Visit& visit) {
    for (const lod::ClusterRange& range : list.ranges) {
        const hierarchy::Page& page = *query.resident[range.page];
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c)
            visit(range.page, page, c);
    }
}

/// Calls `visit(corners)` for the triangles of a cluster, with corners in local space, until `visit` returns true.
/// Returns true if a call returned true.
template <class Visit>
bool anyTriangle(const hierarchy::Grid& grid, const hierarchy::Page& page, std::uint32_t cluster, const Visit& visit) {
    const hierarchy::Cluster& c = page.clusters[cluster];
    for (std::uint32_t t = c.firstTriangle; t < c.firstTriangle + c.triangleCount; ++t) {
        std::array<glm::dvec3, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i)
            corners[i] = grid.local(page.vertices[c.firstVertex + page.triangles[t][i]].position);
        if (visit(corners)) return true;
    }
    return false;
}

/// Returns the stored error of a cluster's refinement if the refinement should be drawn but is not in memory. Otherwise
/// returns 0.
double missingError(const lod::CutQuery& query, const hierarchy::Page& page, std::uint32_t cluster) {
    if (page.clusters[cluster].refinement == hierarchy::kNone) return 0;
    const hierarchy::Refinement& finer = page.refinements[page.clusters[cluster].refinement];
    // the refinement is in memory, so the cut would have drawn it if it were required
    if (query.resident[finer.group.page] != nullptr) return 0;
    return query.rule->exceeds(finer.bounds, finer.drawnError(), query.errorPixels) ? finer.error : 0;
}

void findCandidates(const lod::CutQuery& query, const lod::DrawList& image, std::vector<DepthCandidate>& result) {
    const lod::DetailView& view = query.rule->view();
    const hierarchy::Grid& grid = query.trees->grid();
    const glm::dvec3 size = glm::abs(view.basis.view) * (0.5 * grid.step());
    const glm::dvec3 along = view.basis.view * (0.5 * grid.step());
    const double eyeDepth = glm::dot(view.basis.view, view.eye);
    result.clear();
    result.reserve(image.clusters);
    forEachCluster(query, image, [&](std::uint32_t id, const hierarchy::Page& page, std::uint32_t c) {
        const hierarchy::GridBox& box = page.clusters[c].box;
        const glm::dvec3 min(box.min.x, box.min.y, box.min.z);
        const glm::dvec3 max(box.max.x, box.max.y, box.max.z);
        const double middle = glm::dot(along, min + max) - eyeDepth;
        const double reach = glm::dot(size, max - min);
        const double margin = missingError(query, page, c);
        result.push_back({middle - reach - margin, middle + reach + margin, id, c, margin});
    });
}

/// Computes the range of view depths of visible triangles. Triangles are tested only if the box of their cluster could
/// extend the range.
class DepthSearch {
public:
    explicit DepthSearch(const lod::CutQuery& query)
        : query_(&query), pyramid_(lod::viewPyramid(query.rule->view())), clipper_(pyramid_) {}

    /// Extends the range of view depths by the visible part of one cluster.
    void measure(const DepthCandidate& candidate, double& minDepth, double& maxDepth) {
        ++measured;
        const lod::DetailView& view = query_->rule->view();
        const hierarchy::Page& page = *query_->resident[candidate.page];
        anyTriangle(query_->trees->grid(), page, candidate.cluster, [&](const std::array<glm::dvec3, 3>& corners) {
            for (const glm::dvec3& point : clipper_.clipped(corners)) {
                const double depth = std::max(0.0, glm::dot(view.basis.view, point - view.eye));
                minDepth = std::min(minDepth, std::max(0.0, depth - candidate.margin));
                maxDepth = std::max(maxDepth, depth + candidate.margin);
            }
            return false;
        });
    }

    std::uint64_t measured = 0;

private:
    const lod::CutQuery* query_;
    ConvexVolume pyramid_;
    TriangleClipper clipper_;
};

} // namespace

std::optional<VisibleDepths> visibleDepthRange(const lod::CutQuery& query, const lod::DrawList& image) {
    std::vector<DepthCandidate> scratch;
    return visibleDepthRange(query, image, scratch);
}

std::optional<VisibleDepths> visibleDepthRange(
    const lod::CutQuery& query, const lod::DrawList& image, std::vector<DepthCandidate>& scratch) {
    findCandidates(query, image, scratch);
    std::vector<DepthCandidate>& heap = scratch;
    DepthSearch search(query);
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    double minDepth = kInfinite;
    double maxDepth = -kInfinite;
    const auto further = [](const DepthCandidate& a, const DepthCandidate& b) { return a.minDepth > b.minDepth; };
    std::make_heap(heap.begin(), heap.end(), further);
    auto end = heap.end();
    for (; end != heap.begin() && heap.front().minDepth < minDepth; --end) {
        search.measure(heap.front(), minDepth, maxDepth);
        std::pop_heap(heap.begin(), end, further);
    }
    if (minDepth == kInfinite) return std::nullopt;
    const auto nearer = [](const DepthCandidate& a, const DepthCandidate& b) { return a.maxDepth < b.maxDepth; };
    std::make_heap(heap.begin(), end, nearer); // the candidates from `end` on have already been measured
    for (; end != heap.begin() && heap.front().maxDepth > maxDepth; --end) {
        search.measure(heap.front(), minDepth, maxDepth);
        std::pop_heap(heap.begin(), end, nearer);
    }
    return VisibleDepths{{minDepth, maxDepth}, search.measured};
}

std::vector<bool> receivingVolumes(
    const lod::CutQuery& query, const lod::DrawList& image, std::span<const ConvexVolume> volumes) {
    const ConvexVolume pyramid = lod::viewPyramid(query.rule->view());
    const hierarchy::Grid& grid = query.trees->grid();
    std::vector<bool> result(volumes.size());
    for (std::size_t v = 0; v < volumes.size(); ++v) {
        ConvexVolume seen = volumes[v];
        seen.planes.insert(seen.planes.end(), pyramid.planes.begin(), pyramid.planes.end());
        TriangleClipper clipper(seen);
        const auto isSeen = [&](const std::array<glm::dvec3, 3>& corners) { return !clipper.clipped(corners).empty(); };
        forEachCluster(query, image, [&](std::uint32_t, const hierarchy::Page& page, std::uint32_t c) {
            if (result[v] || classify(seen, grid.local(page.clusters[c].box)) == Containment::Outside) return;
            result[v] = anyTriangle(grid, page, c, isSeen);
        });
    }
    return result;
}

} // namespace gnomon::lod
