#include "preprocess/pipeline/rounds.h"

#include <algorithm>

namespace gnomon::pipeline {

namespace {

constexpr std::uint64_t kAlwaysAffordable = 8192;
// Max share of the triangles that a useful round leaves. If a round leaves more, the next round is the last.
constexpr double kMinProgress = 0.8;

} // namespace

Round firstRound(std::uint32_t chunkCount) {
    Round round;
    round.nodeCount = chunkCount;
    round.isLast = chunkCount == 1;
    return round;
}

Round roundAfter(const Round& round, const std::vector<NodeRecord>& finished, const RoundRecord& record) {
    Round next;
    next.number = round.number + 1;
    next.firstLevel = round.firstLevel;
    for (const NodeRecord& node : finished)
        next.firstLevel = std::max(next.firstLevel, round.firstLevel + static_cast<std::uint32_t>(node.levels.size()));
    next.nodeCount = static_cast<std::uint32_t>(record.nodes.size());
    next.isLast = record.isLast;
    for (const ClusterSums& node : record.nodes)
        next.largestNode.growTo({node.triangles, node.vertices});
    return next;
}

std::uint64_t nodeTriangles(std::uint32_t chunkTriangles) {
    return std::max<std::uint64_t>(chunkTriangles, kAlwaysAffordable);
}

bool isLastRound(std::size_t nodeCount, std::uint64_t triangles, std::uint64_t before) {
    return nodeCount <= 1 || static_cast<double>(triangles) > kMinProgress * static_cast<double>(before);
}

} // namespace gnomon::pipeline
