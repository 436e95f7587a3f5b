// The rounds of a build. Each round builds several parts of the model (nodes) independently. The last round builds the
// root.
#pragma once

#include "preprocess/pipeline/checkpoint_log.h"

namespace gnomon::pipeline {

/// The number of levels of detail that a round builds per part of the model. The remaining clusters are then sorted
/// into new parts.
constexpr std::uint32_t kLevelsPerRound = 2;

/// A round of a build: a set of nodes (parts of the model) that are built independently. In round 0 a node is a chunk.
/// In later rounds a node contains the clusters in a cell of the round's octree.
struct Round {
    std::uint32_t number = 0;
    std::uint32_t firstLevel = 0;
    std::uint32_t nodeCount = 0;
    bool isLast = false;         // whether the nodes are built up to their roots
    chunk::PartSize largestNode; // set for rounds after the first
};

/// Returns round 0 of a build, whose nodes are the chunks of the source.
Round firstRound(std::uint32_t chunkCount);

/// Returns the round after `round`. `finished` are the records of all nodes of `round`, and `record` is the record of
/// the new round.
Round roundAfter(const Round& round, const std::vector<NodeRecord>& finished, const RoundRecord& record);

/// Returns the max number of triangles of a node (part of the model) in rounds after the first. It is `chunkTriangles`,
/// or a small number that always fits into memory.
std::uint64_t nodeTriangles(std::uint32_t chunkTriangles);

/// Returns true if a round is the last one. The round has `nodeCount` nodes with `triangles` triangles. `before` is the
/// number of triangles at the start of the previous round. A round is the last one in two cases: it has only one node,
/// or the previous round hardly reduced the number of triangles. In the second case borders between nodes are not the
/// cause, so another round would not help.
bool isLastRound(std::size_t nodeCount, std::uint64_t triangles, std::uint64_t before);

} // namespace gnomon::pipeline
