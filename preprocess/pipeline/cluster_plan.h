// Assigns each cluster to a node of the next round, with an octree over the cluster places. The cells of the octree are
// shifted in each round.
#pragma once

#include "preprocess/levels/open_clusters.h"

namespace gnomon::pipeline {

/// Returns the shift of the cells of a round's octree along each axis, in grid steps, for positions up to `furthest`.
/// The shift is 0, 1/3 and 2/3 of the root cube in turn, rounded. At any depth, a face of a cell is therefore at least
/// a third of a cell away from the faces of the previous and the next round.
std::uint32_t cellShift(const hierarchy::GridPoint& furthest, std::uint32_t round);

/// The totals of the clusters of a node.
struct ClusterSums {
    std::uint64_t clusters = 0;
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0; // sum over the clusters; shared vertices count repeatedly
};

/// The nodes of a round and the node of each cluster.
struct ClusterPlan {
    std::vector<std::uint32_t> nodeOf; // per cluster
    std::vector<ClusterSums> nodes;
};

/// Divides the clusters at `places` into nodes of at most `nodeTriangles` triangles. A single larger cluster is its own
/// node. Nodes follow the Morton order of the cells of `round`. Clusters at one point keep their order. The function is
/// pure.
ClusterPlan planClusters(
    std::span<const levels::ClusterPlace> places,
    const hierarchy::GridPoint& furthest,
    std::uint32_t round,
    std::uint64_t nodeTriangles);

} // namespace gnomon::pipeline
