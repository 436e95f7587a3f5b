// Which parts of the model are built together, round after round, until one is left.
#pragma once

#include "preprocess/pipeline/checkpoint_log.h"

namespace gnomon::pipeline {

/// How many levels a part gets before the clusters that are left are binned anew.
constexpr std::uint32_t kLevelsPerRound = 2;

/// A round of parts that are built independently. In round 0 a node is a chunk; later it is what the round's octree has
/// put together.
struct Round {
    std::uint32_t number = 0;
    std::uint32_t firstLevel = 0;
    std::uint32_t nodeCount = 0;
    bool isLast = false;         // nodes are built up to their roots
    chunk::PartSize largestNode; // where the round is not the first
};

/// The chunks.
Round firstRound(std::uint32_t chunkCount);

/// The round of `record`, after one whose nodes are `finished`.
Round roundAfter(const Round& round, const std::vector<NodeRecord>& finished, const RoundRecord& record);

/// The most triangles that a node of a later round may have, where chunks have `chunkTriangles`: as many, or a small
/// number that is always affordable.
std::uint64_t nodeTriangles(std::uint32_t chunkTriangles);

/// Whether a round of `nodeCount` nodes and `triangles` triangles, after one that began with `before`, is the last: one
/// node is left, or triangles hardly get fewer, so that it is not borders that keep them.
bool isLastRound(std::size_t nodeCount, std::uint64_t triangles, std::uint64_t before);

} // namespace gnomon::pipeline
