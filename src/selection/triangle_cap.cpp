#include "selection/cut.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::selection {
namespace {

/// The thresholds for which a cluster is drawn: from `least` up to, but not at, `end`.
struct DrawnAt {
    double least = 0;
    double end = 0;
    std::uint32_t triangles = 0;
};

std::uint64_t trianglesAt(std::span<const DrawnAt> clusters, double errorPixels) {
    std::uint64_t result = 0;
    for (const DrawnAt& cluster : clusters)
        result += cluster.least <= errorPixels && errorPixels < cluster.end ? cluster.triangles : 0;
    return result;
}

/// Of the clusters in the first volume that any threshold from the query's upwards draws.
std::vector<DrawnAt> drawnClusters(const CutQuery& all) {
    CutQuery query = all;
    query.volumes = all.volumes.first(1);
    const hierarchy::Grid& grid = query.trees->grid();
    const auto isOutside = [&](bvh::VolumeMask mask, const hierarchy::GridBox& box) {
        return mask.undecided() != 0 && classify(query.volumes[0], grid.local(box)) == Containment::Outside;
    };
    std::vector<DrawnAt> result;
    std::vector<std::uint32_t> missingRoots;
    for (const PageVisit& visit : visitedPages(query, missingRoots)) {
        if (visit.mask.touching == 0) continue;
        const hierarchy::Page& page = *query.resident[visit.page];
        std::vector<double> refined;
        for (const hierarchy::Refinement& refinement : page.refinements)
            refined.push_back(
                query.resident[refinement.group.page] == nullptr
                    ? 0
                    : query.rule->pixels(refinement.bounds, refinement.error));
        for (const hierarchy::Group& group : page.groups) {
            const double end = query.rule->pixels(group.bounds, group.error);
            if (!(end > query.errorPixels) || isOutside(visit.mask, group.box)) continue;
            for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
                const hierarchy::Cluster& cluster = page.clusters[c];
                if (isOutside(visit.mask, cluster.box)) continue;
                const double least = cluster.refinement == hierarchy::kNone ? 0 : refined[cluster.refinement];
                result.push_back({least, end, cluster.triangleCount});
            }
        }
    }
    return result;
}

} // namespace

double cappedErrorPixels(const CutQuery& query, std::uint64_t maxTriangles) {
    const std::vector<DrawnAt> clusters = drawnClusters(query);
    if (trianglesAt(clusters, query.errorPixels) <= maxTriangles) return query.errorPixels;
    double coarsest = query.errorPixels; // beyond it nothing is refined but the roots
    for (const DrawnAt& cluster : clusters)
        coarsest = std::max({coarsest, cluster.least, std::isfinite(cluster.end) ? cluster.end : 0});
    double tooMany = std::max(query.errorPixels, std::numeric_limits<double>::min());
    double enough = coarsest;
    while (enough > tooMany * 1.001) {
        const double middle = std::sqrt(tooMany) * std::sqrt(enough);
        (trianglesAt(clusters, middle) <= maxTriangles ? enough : tooMany) = middle;
    }
    return enough;
}

} // namespace gnomon::selection
