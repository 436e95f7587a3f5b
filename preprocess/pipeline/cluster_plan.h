// Which node of the next round each cluster goes to: an octree of the clusters' places, whose cells lie elsewhere in
// each round.
#pragma once

#include "preprocess/levels/pending_level.h"

namespace gnomon::pipeline {

/// How far the cells of a round's octree are shifted along each axis, in steps of the grid, for positions up to
/// `furthest`: 0, 1/3 and 2/3 of the root cube in turn, rounded. So no face of a cell lies within a third of a cell of
/// a face of the last or the next round's cells, at any depth.
std::uint32_t cellShift(const hierarchy::GridPoint& furthest, std::uint32_t round);

/// What a node begins with.
struct ClusterSums {
    std::uint64_t clusters = 0;
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0; // of all clusters, each by itself
};

struct ClusterPlan {
    std::vector<std::uint32_t> nodeOf; // of each cluster
    std::vector<ClusterSums> nodes;
};

/// Cuts the clusters at `places` into nodes of at most `nodeTriangles` triangles, at least those of a cluster, in the
/// Morton order of round `round`'s cells, clusters at one point in their own order. A pure function of its arguments.
ClusterPlan planClusters(
    std::span<const levels::ClusterPlace> places,
    const hierarchy::GridPoint& furthest,
    std::uint32_t round,
    std::uint64_t nodeTriangles);

} // namespace gnomon::pipeline
