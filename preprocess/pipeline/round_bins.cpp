#include "preprocess/pipeline/round_bins.h"

#include "preprocess/pipeline/memory_plan.h"

#include <algorithm>
#include <numeric>

namespace gnomon::pipeline {

namespace {

/// Returns the number of streams into which border positions are sorted. `bytes` is the size of all clusters without
/// groups. Each finished node writes one block into each stream. Only one stream at a time is in memory.
std::uint32_t borderStreamsFor(std::uint64_t bytes, std::uint32_t nodeCount) {
    constexpr std::uint64_t kMinBins = 16;
    constexpr std::uint64_t kMaxBins = 256;
    const std::uint64_t wanted = std::clamp(bytes / mebibytes(16).count, kMinBins, kMaxBins);
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(nodeCount, 1, wanted));
}

std::uint64_t bytesLeftBy(const NodeRecord& node) {
    return node.places.bytes + node.clusters.bytes;
}

} // namespace

Round RoundBins::next(const Round& round, const BinningMeans& means) {
    const RoundRecord* record = log().binnedRound(round.number + 1);
    const Blocks left = leftBlocks(round);
    if (record == nullptr) {
        workDirectory_.finish(bin(round, means), left);
        record = log().binnedRound(round.number + 1);
    } else {
        workDirectory_.release(left);
    }
    bins_.emplace(workDirectory_.scratch(), record->directory);
    return roundAfter(round, log().nodes(round.number), *record);
}

std::vector<levels::ClusterPlace> RoundBins::placesOf(const Round& round) const {
    std::vector<levels::ClusterPlace> places;
    std::uint64_t count = 0;
    for (const NodeRecord& node : log().nodes(round.number))
        count += node.pending.clusters;
    places.reserve(count);
    workDirectory_.scratch().reopenOthers();
    for (const NodeRecord& node : log().nodes(round.number)) {
        const std::vector<std::byte> bytes = workDirectory_.scratch().read({&node.places, 1});
        const std::vector<levels::ClusterPlace> own = levels::clusterPlaces(bytes);
        places.insert(places.end(), own.begin(), own.end());
        progress_.advance(0);
    }
    return places;
}

RoundRecord RoundBins::bin(const Round& round, const BinningMeans& means) {
    RoundRecord record;
    record.round = round.number + 1;
    const ClusterPlan plan =
        planClusters(placesOf(round), log().binned()->furthest, record.round, nodeTriangles(means.chunkTriangles));
    record.nodes = plan.nodes;
    std::uint64_t before = 0;
    std::uint64_t left = 0;
    for (const NodeRecord& node : log().nodes(round.number)) {
        left += node.pending.triangles;
        if (round.number == 0 && !node.levels.empty()) before += node.levels.front().info.triangles;
    }
    if (const RoundRecord* own = log().binnedRound(round.number))
        for (const ClusterSums& node : own->nodes)
            before += node.triangles;
    record.isLast = isLastRound(plan.nodes.size(), left, before);
    routeAll(round, means, plan, record.locks);
    record.directory = bins_->directory();
    return record;
}

void RoundBins::routeAll(const Round& round, const BinningMeans& means, const ClusterPlan& plan, LockCounts& locks) {
    const std::vector<NodeRecord>& nodes = log().nodes(round.number);
    const auto nodeCount = static_cast<std::uint32_t>(plan.nodes.size());
    std::vector<std::size_t> firstCluster(1, 0); // per finished node: index of its first cluster
    Bytes maxBytes;
    std::uint64_t leftBytes = 0;
    TaskPhase phase;
    phase.kind = TaskKind::RouteClusters;
    for (const NodeRecord& node : nodes) {
        firstCluster.push_back(firstCluster.back() + node.pending.clusters);
        maxBytes = std::max(maxBytes, MemoryNeeds::routing(bytesLeftBy(node), node.pending.vertices));
        leftBytes += bytesLeftBy(node);
        phase.tasks.push_back(node.node);
    }
    const std::uint32_t borderStreams = borderStreamsFor(leftBytes, nodeCount);
    phase.atOnce = std::max<std::size_t>(countAtOnce(means.room, maxBytes, means.threads), 1);
    phase.weight = [&](std::uint32_t node) { return bytesLeftBy(nodes[node]); };
    phase.input = [&](std::uint32_t node) {
        const auto begin = plan.nodeOf.begin() + static_cast<std::ptrdiff_t>(firstCluster[node]);
        return encoded(RouteInput{
            {nodes[node].places, nodes[node].clusters},
            nodes[node].firstLevel,
            borderStreams,
            log().firstPages(round.number, node),
            {begin, begin + static_cast<std::ptrdiff_t>(nodes[node].pending.clusters)}});
    };
    std::vector<RoutedMail> mail(nodes.size());
    phase.take = [&](std::uint32_t node, std::span<const std::byte> result) {
        mail[node] = decodedRoutedMail(result);
        locks.locked += mail[node].counts.locked;
        progress_.advance(0);
    };
    means.runner.run(phase, means.perform);
    bins_.emplace(workDirectory_.scratch(), nodeCount * static_cast<std::uint32_t>(Stream::Count), 1);
    // The results are stored in node order, so that the bytes do not depend on the order in which tasks finish.
    for (const RoutedMail& routed : mail) {
        deliver(Stream::Records, routed.records);
        deliver(Stream::Locks, routed.locks);
        deliver(Stream::Borders, routed.borders);
    }
    shareBorders(borderStreams, phase.atOnce, means, locks);
}

void RoundBins::deliver(Stream kind, const Mail& mail) {
    for (const auto& [node, block] : mail)
        bins_->adopt(chunk::streamOf(kind, node), block);
}

void RoundBins::shareBorders(std::uint32_t streams, std::size_t atOnce, const BinningMeans& means, LockCounts& locks) {
    TaskPhase phase;
    phase.kind = TaskKind::ShareLocks;
    phase.tasks.resize(streams);
    std::iota(phase.tasks.begin(), phase.tasks.end(), 0U);
    phase.atOnce = atOnce;
    phase.weight = [&](std::uint32_t stream) { return bins_->bytes(chunk::streamOf(Stream::Borders, stream)); };
    phase.input = [&](std::uint32_t stream) {
        return locksInput(bins_->blocks(chunk::streamOf(Stream::Borders, stream)));
    };
    std::vector<Mail> mail(streams);
    phase.take = [&](std::uint32_t stream, std::span<const std::byte> result) {
        RoutedMail shared = decodedRoutedMail(result);
        mail[stream] = std::move(shared.locks);
        locks.locked += shared.counts.locked;
        locks.lockedBefore += shared.counts.lockedBefore;
        progress_.advance(0);
    };
    means.runner.run(phase, means.perform);
    for (const Mail& locked : mail)
        deliver(Stream::Locks, locked);
    for (std::uint32_t stream = 0; stream < streams; ++stream)
        bins_->release(chunk::streamOf(Stream::Borders, stream));
}

NodeInput RoundBins::input(const Round& round, std::uint32_t node) const {
    NodeInput input;
    input.round = round.number;
    input.node = node;
    input.firstLevel = round.firstLevel;
    input.isLast = round.isLast;
    input.sums = log().binnedRound(round.number)->nodes[node];
    input.records = bins_->blocks(chunk::streamOf(Stream::Records, node));
    input.locks = bins_->blocks(chunk::streamOf(Stream::Locks, node));
    return input;
}

Blocks RoundBins::takeBlocks(std::uint32_t node) {
    Blocks all = bins_->takeBlocks(chunk::streamOf(Stream::Records, node));
    const Blocks locks = bins_->takeBlocks(chunk::streamOf(Stream::Locks, node));
    all.insert(all.end(), locks.begin(), locks.end());
    return all;
}

Blocks RoundBins::leftBlocks(const Round& round) const {
    Blocks blocks;
    for (const NodeRecord& node : log().nodes(round.number))
        blocks.insert(blocks.end(), {node.places, node.clusters});
    return blocks;
}

} // namespace gnomon::pipeline
