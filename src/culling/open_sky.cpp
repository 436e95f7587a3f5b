#include "culling/open_sky.h"

#include <tbb/parallel_for.h>

#include <array>
#include <atomic>
#include <cmath>

namespace gnomon::culling {

namespace {

/// A plane through a visible triangle: what lies before it is dot(normal, p) > offset.
struct SeenPlane {
    glm::dvec3 normal{0};
    double offset = 0;

    bool mayHold(const Box& box) const {
        return glm::dot(normal, box.center()) + glm::dot(glm::abs(normal), 0.5 * box.extent()) > offset;
    }

    bool holds(const glm::dvec3& point) const { return glm::dot(normal, point) > offset; }
};

class OpenSkySearch {
public:
    OpenSkySearch(const selection::CutQuery& query, const selection::DrawList& image, const Box& bounds)
        : query_(&query), image_(&image), grid_(query.trees->grid()), bounds_(bounds) {
        const ConvexVolume pyramid = selection::viewPyramid(query.rule->view());
        isAllInView_ = classify(pyramid, bounds) == Containment::Inside;
        for (const selection::ClusterRange& range : image.ranges) {
            Box box;
            const hierarchy::Page& page = *query.resident[range.page];
            for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c)
                box.add(grid_.local(page.clusters[c].box));
            rangeBoxes_.push_back(box);
        }
    }

    bool isFound(const selection::ClusterRange& range) const {
        const hierarchy::Page& page = *query_->resident[range.page];
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            const hierarchy::Cluster& cluster = page.clusters[c];
            for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t) {
                std::array<glm::dvec3, 3> corners{};
                for (std::size_t i = 0; i < 3; ++i)
                    corners[i] = grid_.local(page.vertices[cluster.firstVertex + page.triangles[t][i]].position);
                if (isFoundBefore(corners)) return true;
            }
        }
        return false;
    }

private:
    bool isFoundBefore(const std::array<glm::dvec3, 3>& corners) const {
        SeenPlane plane;
        plane.normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double length = glm::length(plane.normal);
        if (!(length > 0)) return false;
        const bool isTurned = glm::dot(plane.normal, query_->rule->view().eye - corners[0]) < 0;
        plane.normal *= (isTurned ? -1 : 1) / length;
        constexpr double kSteps = 2;
        plane.offset = glm::dot(plane.normal, corners[0]) + kSteps * grid_.step();
        if (!plane.mayHold(bounds_)) return false;
        if (!isAllInView_) return true;
        for (std::size_t i = 0; i < rangeBoxes_.size(); ++i)
            if (plane.mayHold(rangeBoxes_[i]) && holds(plane, image_->ranges[i])) return true;
        return false;
    }

    bool holds(const SeenPlane& plane, const selection::ClusterRange& range) const {
        const hierarchy::Page& page = *query_->resident[range.page];
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            const hierarchy::Cluster& cluster = page.clusters[c];
            if (!plane.mayHold(grid_.local(cluster.box))) continue;
            for (std::uint32_t v = 0; v < cluster.vertexCount; ++v)
                if (plane.holds(grid_.local(page.vertices[cluster.firstVertex + v].position))) return true;
        }
        return false;
    }

    const selection::CutQuery* query_;
    const selection::DrawList* image_;
    hierarchy::Grid grid_;
    Box bounds_;
    bool isAllInView_ = false;
    std::vector<Box> rangeBoxes_;
};

} // namespace

bool mayHideSky(const selection::CutQuery& query, const selection::DrawList& image, const Box& bounds) {
    const OpenSkySearch search(query, image, bounds);
    std::atomic<bool> isFound = false;
    tbb::parallel_for(std::size_t{0}, image.ranges.size(), [&](std::size_t i) {
        if (isFound.load(std::memory_order_relaxed)) return;
        if (search.isFound(image.ranges[i])) isFound.store(true, std::memory_order_relaxed);
    });
    return isFound.load();
}

} // namespace gnomon::culling
