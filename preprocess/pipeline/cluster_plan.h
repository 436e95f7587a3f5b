// Assigns each cluster to a node of the next round, which is built separately. The nodes are cells of an octree. The
// octree is shifted differently in each round.
#pragma once

#include "preprocess/levels/open_clusters.h"

namespace gnomon::pipeline {

/// Returns the shift of the octree in a round, in grid steps. It is the same on each axis. `furthest` contains the max
/// coordinates of the positions. In consecutive rounds the shift is 0, 1/3 or 2/3 of the side of the root cube,
/// rounded. At any depth of the octree, a face of a cell is therefore at least a third of a cell away from the faces of
/// the previous and the next round.
std::uint32_t cellShift(const hierarchy::GridPoint& furthest, std::uint32_t round);

/// The numbers of clusters, triangles and vertices of a node, which is a part of the model.
struct ClusterSums {
    std::uint64_t clusters = 0;
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0; // sum over the clusters; a vertex counts once per cluster that uses it
};

/// The nodes of a round, and the assignment of clusters to these nodes.
struct ClusterPlan {
    std::vector<std::uint32_t> nodeOf; // per cluster: index of its node
    std::vector<ClusterSums> nodes;
};

/// Divides the clusters at `places` into nodes of at most `nodeTriangles` triangles. A node is a part of the model that
/// is built separately. A cluster with more triangles is a node of its own. Nodes are in the Morton order of the octree
/// cells of `round`. Clusters at the same point stay in order. The function is pure.
ClusterPlan planClusters(
    std::span<const levels::ClusterPlace> places,
    const hierarchy::GridPoint& furthest,
    std::uint32_t round,
    std::uint64_t nodeTriangles);

} // namespace gnomon::pipeline
