#include "preprocess/pipeline/cluster_plan.h"

#include "preprocess/chunk/chunk_tree.h"

#include <algorithm>
#include <bit>

namespace gnomon::pipeline {

namespace {

using hierarchy::GridPoint;

constexpr int kRootBits = 5; // the root table is small, because there are few clusters

GridPoint shifted(const GridPoint& p, std::uint32_t shift) {
    return {p.x + shift, p.y + shift, p.z + shift};
}

chunk::ChunkTree treeOf(
    std::span<const levels::ClusterPlace> places, const GridPoint& furthest, std::uint32_t shift, std::uint64_t limit) {
    chunk::CellCounts counts(shifted(furthest, shift), kRootBits);
    do {
        for (const levels::ClusterPlace& place : places)
            counts.add(shifted(place.center, shift), place.triangles);
    } while (counts.refine(limit / 8));
    return {counts, limit};
}

/// The node that receives the next clusters, and its number of triangles so far.
struct Filling {
    std::uint32_t node = 0; // number of the node within its part of the octree
    std::uint64_t triangles = 0;

    void add(std::uint64_t more, std::uint64_t limit) {
        if (triangles > 0 && triangles + more > limit) {
            ++node;
            triangles = 0;
        }
        triangles += more;
    }
};

} // namespace

std::uint32_t cellShift(const GridPoint& furthest, std::uint32_t round) {
    const auto width = static_cast<unsigned>(std::bit_width(std::max({furthest.x, furthest.y, furthest.z, 1U})));
    return static_cast<std::uint32_t>(((std::uint64_t{1} << width) * (round % 3) + 1) / 3);
}

ClusterPlan planClusters(
    std::span<const levels::ClusterPlace> places,
    const GridPoint& furthest,
    std::uint32_t round,
    std::uint64_t nodeTriangles) {
    ClusterPlan plan;
    const std::uint32_t shift = cellShift(furthest, round);
    const chunk::ChunkTree tree = treeOf(places, furthest, shift, nodeTriangles);
    plan.nodeOf.reserve(places.size());
    // Each part of the octree becomes one node. A part becomes several nodes if a single point has more triangles than
    // a node may have.
    std::vector<Filling> filling(tree.chunkCount());
    for (const levels::ClusterPlace& place : places)
        filling[tree.chunkOf(shifted(place.center, shift))].add(place.triangles, nodeTriangles);
    std::vector<std::uint32_t> firstNode;
    std::uint32_t nodes = 0;
    for (Filling& part : filling) {
        firstNode.push_back(nodes);
        nodes += part.node + 1;
        part = {};
    }
    plan.nodes.resize(nodes);
    for (const levels::ClusterPlace& place : places) {
        const std::uint32_t part = tree.chunkOf(shifted(place.center, shift));
        filling[part].add(place.triangles, nodeTriangles);
        plan.nodeOf.push_back(firstNode[part] + filling[part].node);
        ClusterSums& node = plan.nodes[plan.nodeOf.back()];
        ++node.clusters;
        node.triangles += place.triangles;
        node.vertices += place.vertices;
    }
    return plan;
}

} // namespace gnomon::pipeline
