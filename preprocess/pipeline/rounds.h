// The rounds of a build. Each round builds several parts of the model independently. The last round builds the root.
#pragma once

#include "preprocess/pipeline/checkpoint_log.h"

namespace gnomon::pipeline {

/// The number of levels that a round builds per part of the model. The remaining clusters are then sorted into new
/// parts.
constexpr std::uint32_t kLevelsPerRound = 2;

/// A round of nodes that are built independently. In round 0 a node is a chunk. In later rounds a node contains the
/// clusters in a cell of the round's octree.
struct Round {
    std::uint32_t number = 0;
    std::uint32_t firstLevel = 0;
    std::uint32_t nodeCount = 0;
    bool isLast = false;         // whether its nodes are built up to their roots
    chunk::PartSize largestNode; // set for rounds after the first
};

/// Returns round 0, whose nodes are the chunks.
Round firstRound(std::uint32_t chunkCount);

/// Returns the round after `round`. `finished` are the built nodes of `round`, and `record` is the record of the new
/// round.
Round roundAfter(const Round& round, const std::vector<NodeRecord>& finished, const RoundRecord& record);

/// Returns the max number of triangles of a node in rounds after the first: `chunkTriangles`, or a small number that
/// always fits into memory.
std::uint64_t nodeTriangles(std::uint32_t chunkTriangles);

/// Returns true if a round of `nodeCount` nodes with `triangles` triangles is the last one. `before` is the number of
/// triangles at the start of the previous round. A round is the last one in two cases: it has only one node, or the
/// previous round hardly reduced the number of triangles. In the second case borders between nodes are not the cause,
/// so another round would not help.
bool isLastRound(std::size_t nodeCount, std::uint64_t triangles, std::uint64_t before);

} // namespace gnomon::pipeline
