#include "lod/cut.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::lod {
namespace {

/// The range of error limits, in pixels, for which a cluster is drawn: from `minPixels` (inclusive) to `end`
/// (exclusive).
struct DrawnAt {
    double minPixels = 0;
    double end = 0;
    std::uint32_t triangles = 0;
};

std::uint64_t trianglesAt(std::span<const DrawnAt> clusters, double errorPixels) {
    std::uint64_t result = 0;
    for (const DrawnAt& cluster : clusters)
        result += cluster.minPixels <= errorPixels && errorPixels < cluster.end ? cluster.triangles : 0;
    return result;
}

/// The clusters of the image that are drawn at any error limit that is at least the limit of the query.
class DrawnClusters {
public:
    explicit DrawnClusters(const CutQuery& query) : query_(&query), volumes_(query.volumes.first(1)) {}

    std::vector<DrawnAt> all() {
        CutQuery query = *query_;
        query.volumes = volumes_;
        std::vector<std::uint32_t> missingRoots;
        for (const PageVisit& visit : visitedPages(query, missingRoots))
            if (visit.mask.touching != 0) add(visit.page, visit.mask);
        return std::move(found_);
    }

private:
    bool isOutside(lod::VolumeMask mask, const hierarchy::GridBox& box) const {
        const Box local = query_->trees->grid().local(box);
        return mask.undecided() != 0 && classify(volumes_[0], local) == Containment::Outside;
    }

    bool isBlocked(const hierarchy::GroupRef& group) const {
        return query_->blocked != nullptr && query_->blocked->contains(group);
    }

    void add(std::uint32_t id, lod::VolumeMask mask) {
        const hierarchy::Page& page = *query_->resident[id];
        refinedBelow_.clear();
        for (const hierarchy::Refinement& finer : page.refinements) {
            const bool canBeRefined = query_->resident[finer.group.page] != nullptr && !isBlocked(finer.group);
            refinedBelow_.push_back(canBeRefined ? query_->rule->pixels(finer.bounds, finer.drawnError()) : 0);
        }
        for (std::uint32_t g = 0; g < page.groups.size(); ++g) {
            if (isBlocked({id, g})) continue;
            const hierarchy::Group& group = page.groups[g];
            const double end = query_->rule->pixels(group.bounds, group.drawnError());
            if (end > query_->errorPixels && !isOutside(mask, group.box)) addGroup(page, group, mask, end);
        }
    }

    void addGroup(const hierarchy::Page& page, const hierarchy::Group& group, lod::VolumeMask mask, double end) {
        for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
            const hierarchy::Cluster& cluster = page.clusters[c];
            const double minPixels = cluster.refinement == hierarchy::kNone ? 0 : refinedBelow_[cluster.refinement];
            if (!isOutside(mask, cluster.box)) found_.push_back({minPixels, end, cluster.triangleCount});
        }
    }

    const CutQuery* query_;
    std::span<const ConvexVolume> volumes_;
    // One entry per refinement of the current page: error limits below this value refine the cluster.
    std::vector<double> refinedBelow_;
    std::vector<DrawnAt> found_;
};

} // namespace

double cappedErrorPixels(const CutQuery& query, std::uint64_t maxTriangles) {
    const std::vector<DrawnAt> clusters = DrawnClusters(query).all();
    if (trianglesAt(clusters, query.errorPixels) <= maxTriangles) return query.errorPixels;
    double coarsest = query.errorPixels; // error limit above which only root groups are refined
    for (const DrawnAt& cluster : clusters)
        coarsest = std::max({coarsest, cluster.minPixels, std::isfinite(cluster.end) ? cluster.end : 0});
    double tooMany = std::max(query.errorPixels, std::numeric_limits<double>::min());
    double feasible = coarsest;
    while (feasible > tooMany * 1.001) {
        const double middle = std::sqrt(tooMany) * std::sqrt(feasible);
        (trianglesAt(clusters, middle) <= maxTriangles ? feasible : tooMany) = middle;
    }
    return feasible;
}

} // namespace gnomon::lod
