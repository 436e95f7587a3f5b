// The rule of every cut, spelled out page by page: slow, and obviously right.
#pragma once

#include "hierarchy/page.h"

#include <concepts>

namespace gnomon::hierarchy {

/// Calls `use(group, cluster)` for each cluster of `page` that is drawn where `isRefined(drawn error, bounds)` decides
/// which groups are refined: its own group is, and its refinement, if it has one, is not. Infinite errors need no
/// question.
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

/// The stored error of a cluster: what its refinement costs to leave out; `snapError` at level 0.
inline double storedError(const Page& page, const Cluster& cluster, double snapError) {
    return cluster.refinement == kNone ? snapError : page.refinements[cluster.refinement].error;
}

/// What a cluster's stored error and that of its attributes come to: from this limit on a uniform cut may draw it.
inline double drawnError(const Page& page, const Cluster& cluster, double snapError) {
    return cluster.refinement == kNone ? snapError : page.refinements[cluster.refinement].drawnError();
}

} // namespace gnomon::hierarchy
