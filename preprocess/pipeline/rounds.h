// Which parts of the model are built together, round after round, until one is left.
#pragma once

#include "preprocess/pipeline/checkpoint_log.h"

namespace gnomon::pipeline {

/// How many levels a part gets before its neighbours are joined to it.
constexpr std::uint32_t kLevelsPerRound = 3;

/// A round of parts that are built independently. In round 0 a node is a chunk; later it is a run of nodes of the round
/// before.
struct Round {
    std::uint32_t number = 0;
    std::uint32_t firstLevel = 0;
    bool isLast = false;             // nodes are built up to their roots
    std::vector<std::uint32_t> ends; // node -> behind its last child; of chunks, in round 0
    chunk::PartSize largestNode;     // where the round is not the first

    std::size_t nodeCount() const { return ends.size(); }

    std::uint32_t firstChild(std::size_t node) const { return node > 0 ? ends[node - 1] : 0; }
};

/// The chunks.
Round firstRound(std::uint32_t chunkCount);

/// The round after one whose nodes are `finished`: neighbours join as long as their triangles are at most
/// `nodeTriangles` (or a small number that is always affordable). It is the last one if one node is left, or if none
/// could join another.
Round nextRound(const Round& round, const std::vector<NodeRecord>& finished, std::uint64_t nodeTriangles);

} // namespace gnomon::pipeline
