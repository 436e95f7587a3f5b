// Bitwise comparison of two pages.
#pragma once

#include "hierarchy/page.h"

#include <algorithm>

namespace gnomon::hierarchy {

inline bool same(const Sphere& a, const Sphere& b) {
    return a.center == b.center && a.radius == b.radius;
}

inline bool same(const GridBox& a, const GridBox& b) {
    return a.min == b.min && a.max == b.max;
}

inline bool samePage(const Page& a, const Page& b) {
    const auto sameGroup = [](const Group& x, const Group& y) {
        return x.firstCluster == y.firstCluster && x.clusterCount == y.clusterCount && same(x.box, y.box) &&
               same(x.bounds, y.bounds) && x.error == y.error && x.attributeError == y.attributeError;
    };
    const auto sameCluster = [](const Cluster& x, const Cluster& y) {
        return x.firstVertex == y.firstVertex && x.firstTriangle == y.firstTriangle && x.vertexCount == y.vertexCount &&
               x.triangleCount == y.triangleCount && x.refinement == y.refinement && same(x.box, y.box);
    };
    const auto sameRefinement = [](const Refinement& x, const Refinement& y) {
        return x.group == y.group && same(x.bounds, y.bounds) && x.error == y.error &&
               x.attributeError == y.attributeError;
    };
    return a.level == b.level && std::ranges::equal(a.groups, b.groups, sameGroup) &&
           std::ranges::equal(a.clusters, b.clusters, sameCluster) &&
           std::ranges::equal(a.refinements, b.refinements, sameRefinement) && a.vertices == b.vertices &&
           a.triangles == b.triangles;
}

} // namespace gnomon::hierarchy
