#include "preprocess/pipeline/rounds.h"

#include <algorithm>
#include <numeric>

namespace gnomon::pipeline {

namespace {

constexpr std::uint64_t kAlwaysAffordable = 8192;

} // namespace

Round firstRound(std::uint32_t chunkCount) {
    Round round;
    round.isLast = chunkCount == 1;
    round.ends.resize(chunkCount);
    std::iota(round.ends.begin(), round.ends.end(), 1U);
    return round;
}

Round nextRound(const Round& round, const std::vector<NodeRecord>& finished, std::uint64_t nodeTriangles) {
    Round next;
    next.number = round.number + 1;
    next.firstLevel = round.firstLevel;
    for (const NodeRecord& node : finished)
        next.firstLevel = std::max(next.firstLevel, round.firstLevel + static_cast<std::uint32_t>(node.levels.size()));
    const std::uint64_t most = std::max(nodeTriangles, kAlwaysAffordable);
    chunk::PartSize sum;
    for (std::uint32_t child = 0; child < finished.size(); ++child) {
        const NodeRecord& own = finished[child];
        if (child > 0 && sum.triangles + own.pending.triangles <= most) {
            next.ends.back() = child + 1;
        } else {
            next.ends.push_back(child + 1);
            sum = {};
        }
        sum.triangles += own.pending.triangles;
        sum.vertices += own.pending.vertices;
        next.largestNode.growTo(sum);
    }
    next.isLast = next.nodeCount() == 1 || next.nodeCount() == finished.size();
    return next;
}

} // namespace gnomon::pipeline
