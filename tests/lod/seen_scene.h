// A random view of the shared model, its cut, and iteration over all drawn clusters and triangles.
#pragma once

#include "tests/support/model_views.h"

#include <array>
#include <cmath>

namespace gnomon::lod {

/// A random view of the shared model and its cut.
struct Seen {
    explicit Seen(Random& random)
        : view(tests::randomView(random, tests::sharedModel().bounds)),
          rule(view),
          volumes{lod::viewPyramid(view)},
          resident(tests::randomResidency(random, tests::sharedModel())),
          errorPixels(std::exp(random.uniform(-4, 2))),
          cut(lod::cut(query())) {}

    lod::CutQuery query() const { return {&tests::sharedModel().trees, resident, &rule, errorPixels, volumes}; }

    lod::DetailView view;
    lod::ErrorRule rule;
    std::vector<ConvexVolume> volumes;
    std::vector<const hierarchy::Page*> resident;
    double errorPixels;
    lod::Cut cut;
};

/// Calls `visit(page, cluster)` for each cluster of `list`.
template <class Visit>
void forEveryCluster(const lod::CutQuery& query, const lod::DrawList& list, const Visit& visit) {
    for (const lod::ClusterRange& range : list.ranges) {
        const hierarchy::Page& page = *query.resident[range.page];
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c)
            visit(page, page.clusters[c]);
    }
}

/// Calls `visit(corners, page, cluster)` for each triangle of `list`. Corners are in local space.
template <class Visit>
void forEveryTriangle(const lod::CutQuery& query, const lod::DrawList& list, const Visit& visit) {
    const hierarchy::Grid& grid = query.trees->grid();
    forEveryCluster(query, list, [&](const hierarchy::Page& page, const hierarchy::Cluster& cluster) {
        for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
            std::array<glm::dvec3, 3> corners{};
            for (std::size_t i = 0; i < 3; ++i)
                corners[i] = grid.local(
                    page.vertices[cluster.firstVertex + page.triangles[cluster.firstTriangle + t][i]].position);
            visit(corners, page, cluster);
        }
    });
}

} // namespace gnomon::lod
