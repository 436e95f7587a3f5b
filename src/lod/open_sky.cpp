#include "lod/open_sky.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <vector>

namespace gnomon::lod {

namespace {

/// The plane of a visible triangle. Points with dot(normal, p) > offset are in front of the plane.
struct SeenPlane {
    glm::dvec3 normal{0};
    double offset = 0;

    bool mayHold(const Box& box) const {
        return glm::dot(normal, box.center()) + glm::dot(glm::abs(normal), 0.5 * box.extent()) > offset;
    }

    bool holds(const glm::dvec3& point) const { return glm::dot(normal, point) > offset; }
};

/// The position of all other geometry relative to a triangle's plane: only behind the plane, only in front of it, or on
/// both sides.
enum class PlaneSide : std::uint8_t { Behind, Before, Both };

class OpenSkySearch {
public:
    OpenSkySearch(const lod::CutQuery& query, const lod::DrawList& image, const Box& bounds)
        : query_(&query), image_(&image), grid_(query.trees->grid()), bounds_(bounds) {
        const ConvexVolume pyramid = lod::viewPyramid(query.rule->view());
        isAllInView_ = classify(pyramid, bounds) == Containment::Inside;
        for (const lod::ClusterRange& range : image.ranges) {
            Box box;
            const hierarchy::Page& page = *query.resident[range.page];
            for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c)
                box.add(grid_.local(page.clusters[c].box));
            rangeBoxes_.push_back(box);
        }
    }

    /// Returns true if geometry may be in front of a triangle of the clusters `range`. If `solids` is Whole and all
    /// geometry is in front of a triangle, the triangle is a back face of a solid. The function then only records this.
    bool isFound(const lod::ClusterRange& range, Solids solids) {
        const hierarchy::Page& page = *query_->resident[range.page];
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            const hierarchy::Cluster& cluster = page.clusters[c];
            for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t) {
                std::array<glm::dvec3, 3> corners{};
                for (std::size_t i = 0; i < 3; ++i)
                    corners[i] = grid_.local(page.vertices[cluster.firstVertex + page.triangles[t][i]].position);
                const PlaneSide side = planeSide(corners);
                if (side == PlaneSide::Both || (side == PlaneSide::Before && solids == Solids::MayBeCut)) return true;
                if (side == PlaneSide::Before) hasFarSides_.store(true, std::memory_order_relaxed);
                if (side == PlaneSide::Behind) hasNearSides_.store(true, std::memory_order_relaxed);
            }
        }
        return false;
    }

    /// Returns true if there are no back faces, or if all back faces are hidden because they belong to a closed solid
    /// seen from outside.
    bool hidesFarSides() const { return !hasFarSides_.load() || (hasNearSides_.load() && isClosed()); }

private:
    PlaneSide planeSide(const std::array<glm::dvec3, 3>& corners) const {
        const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double length = glm::length(across);
        if (!(length > 0)) return PlaneSide::Behind;
        const bool isTurned = glm::dot(across, query_->rule->view().eye - corners[0]) < 0;
        const glm::dvec3 normal = across * ((isTurned ? -1 : 1) / length);
        if (!isAnyBefore(normal, corners[0])) return PlaneSide::Behind;
        return isAllInView_ && !isAnyBefore(-normal, corners[0]) ? PlaneSide::Before : PlaneSide::Both;
    }

    /// Returns true if geometry of the model may be in front of the plane through `point`, on the side of `normal`.
    bool isAnyBefore(const glm::dvec3& normal, const glm::dvec3& point) const {
        constexpr double kSteps = 2;
        const SeenPlane plane{normal, glm::dot(normal, point) + kSteps * grid_.step()};
        if (!plane.mayHold(bounds_)) return false;
        if (!isAllInView_) return true;
        for (std::size_t i = 0; i < rangeBoxes_.size(); ++i)
            if (plane.mayHold(rangeBoxes_[i]) && holds(plane, image_->ranges[i])) return true;
        return false;
    }

    /// Returns true if each edge of the drawn mesh belongs to exactly two triangles.
    bool isClosed() const {
        std::vector<std::array<hierarchy::GridPoint, 2>> edges;
        for (const lod::ClusterRange& range : image_->ranges)
            addEdges(range, edges);
        std::sort(edges.begin(), edges.end());
        for (std::size_t i = 0; i < edges.size();) {
            std::size_t end = i;
            while (end < edges.size() && edges[end] == edges[i])
                ++end;
            if (end - i != 2) return false;
            i = end;
        }
        return !edges.empty();
    }

    void addEdges(const lod::ClusterRange& range, std::vector<std::array<hierarchy::GridPoint, 2>>& edges) const {
        const hierarchy::Page& page = *query_->resident[range.page];
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            const hierarchy::Cluster& cluster = page.clusters[c];
            const auto place = [&](std::uint32_t triangle, std::size_t corner) {
                return page.vertices[cluster.firstVertex + page.triangles[triangle][corner]].position;
            };
            for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t)
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto [first, last] = std::minmax({place(t, k), place(t, (k + 1) % 3)});
                    edges.push_back({first, last});
                }
        }
    }

    bool holds(const SeenPlane& plane, const lod::ClusterRange& range) const {
        const hierarchy::Page& page = *query_->resident[range.page];
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            const hierarchy::Cluster& cluster = page.clusters[c];
            if (!plane.mayHold(grid_.local(cluster.box))) continue;
            for (std::uint32_t v = 0; v < cluster.vertexCount; ++v)
                if (plane.holds(grid_.local(page.vertices[cluster.firstVertex + v].position))) return true;
        }
        return false;
    }

    const lod::CutQuery* query_;
    const lod::DrawList* image_;
    hierarchy::Grid grid_;
    Box bounds_;
    bool isAllInView_ = false;
    std::vector<Box> rangeBoxes_;
    std::atomic<bool> hasFarSides_ = false;
    std::atomic<bool> hasNearSides_ = false;
};

} // namespace

bool mayHideSky(const lod::CutQuery& query, const lod::DrawList& image, const Box& bounds, Solids solids) {
    OpenSkySearch search(query, image, bounds);
    std::atomic<bool> isFound = false;
    tbb::parallel_for(std::size_t{0}, image.ranges.size(), [&](std::size_t i) {
        if (isFound.load(std::memory_order_relaxed)) return;
        if (search.isFound(image.ranges[i], solids)) isFound.store(true, std::memory_order_relaxed);
    });
    return isFound.load() || !search.hidesFarSides();
}

} // namespace gnomon::lod
