// Selects the clusters that are drawn for a view (the cut), page by page. This code is simple and slow. Tests compare
// the fast implementations with it.
#pragma once

#include "hierarchy/page.h"

#include <concepts>

namespace gnomon::hierarchy {

/// Calls `use(group, cluster)` for each cluster of `page` that is drawn. A cluster is drawn if its own group is refined
/// and the finer group that it was simplified from is absent or not refined. `isRefined(drawn error, bounds)` returns
/// true if a group is refined. Groups with infinite error are refined without a call.
template <class IsRefined, class Use>
requires std::predicate<const IsRefined&, double, const Sphere&>

void forEachDrawn(const Page& page, const IsRefined& isRefined, const Use& use) {
    for (const Group& group : page.groups) {
        if (group.error < std::numeric_limits<double>::infinity() && !isRefined(group.drawnError(), group.bounds))
            continue;
        for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
            const Cluster& cluster = page.clusters[c];
            if (cluster.refinement != kNone) {
                const Refinement& finer = page.refinements[cluster.refinement];
                if (isRefined(finer.drawnError(), finer.bounds)) continue;
            }
            use(group, cluster);
        }
    }
}

/// Returns the stored error of a cluster in world units: the error of the finer group that it was simplified from. At
/// level 0 this is `snapError`, the rounding error of the grid.
inline double storedError(const Page& page, const Cluster& cluster, double snapError) {
    return cluster.refinement == kNone ? snapError : page.refinements[cluster.refinement].error;
}

/// Returns the larger of the stored error and the attribute error of a cluster. The cluster can be drawn if the error
/// limit of the whole model is at least this value.
inline double drawnError(const Page& page, const Cluster& cluster, double snapError) {
    return cluster.refinement == kNone ? snapError : page.refinements[cluster.refinement].drawnError();
}

} // namespace gnomon::hierarchy
