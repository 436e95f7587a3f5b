// The rounds of a build. Each round builds parts of the model, until one part is left.
#pragma once

#include "preprocess/pipeline/checkpoint_log.h"

namespace gnomon::pipeline {

/// The number of levels that a part gets per round. Then its remaining clusters are binned again.
constexpr std::uint32_t kLevelsPerRound = 2;

/// A round of nodes that are built independently. In round 0 a node is a chunk. In later rounds a node contains the
/// clusters of a cell of the round's octree.
struct Round {
    std::uint32_t number = 0;
    std::uint32_t firstLevel = 0;
    std::uint32_t nodeCount = 0;
    bool isLast = false;         // builds nodes up to their roots
    chunk::PartSize largestNode; // set for rounds after the first
};

/// Returns round 0, whose nodes are the chunks.
Round firstRound(std::uint32_t chunkCount);

/// Returns the round of `record`, which follows `round` with the nodes `finished`.
Round roundAfter(const Round& round, const std::vector<NodeRecord>& finished, const RoundRecord& record);

/// Returns the max number of triangles of a node of a later round: `chunkTriangles`, or a small number that always fits
/// in memory.
std::uint64_t nodeTriangles(std::uint32_t chunkTriangles);

/// Returns true if a round of `nodeCount` nodes and `triangles` triangles is the last one. `before` is the number of
/// triangles at the start of the previous round. A round is the last if it has one node, or if the number of triangles
/// hardly decreased. In the second case the borders are not the cause.
bool isLastRound(std::size_t nodeCount, std::uint64_t triangles, std::uint64_t before);

} // namespace gnomon::pipeline
