#include "preprocess/pipeline/round_bins.h"

#include "preprocess/chunk/in_order.h"
#include "preprocess/pipeline/memory_plan.h"

#include <algorithm>

namespace gnomon::pipeline {

RoundBins::RoundBins(WorkDirectory& workDirectory, Progress& progress)
    : workDirectory_(workDirectory), progress_(progress) {
    std::optional<std::uint64_t> leftEnd;
    for (std::uint32_t round = 0; round < log().roundCount(); ++round)
        for (const NodeRecord& node : log().nodes(round))
            leftEnd = std::max(leftEnd.value_or(0), node.pendingOffset + node.pendingBytes);
    leftFile_ = workDirectory_.scratch("pending", leftEnd);
    std::optional<std::uint64_t> binsEnd;
    for (std::uint32_t round = 1; const RoundRecord* record = log().binnedRound(round); ++round)
        binsEnd = record->scratchEnd;
    binsFile_ = workDirectory_.scratch("rounds", binsEnd);
}

void RoundBins::keep(const levels::EncodedPendingLevel& left, NodeRecord& record) {
    record.pendingBytes = left.bytes.size();
    record.pendingOffset = leftFile_->append(left.bytes);
    record.pending = {left.clusters, left.triangles, left.vertices};
}

Round RoundBins::next(const Round& round, const BinningMeans& means) {
    const RoundRecord* record = log().binnedRound(round.number + 1);
    if (record == nullptr) {
        workDirectory_.finish(bin(round, means));
        record = log().binnedRound(round.number + 1);
    }
    bins_.emplace(*binsFile_, record->directory);
    round_ = record->round;
    releaseLeft(round);
    return roundAfter(round, log().nodes(round.number), *record);
}

std::vector<levels::ClusterPlace> RoundBins::placesOf(const Round& round) const {
    std::vector<levels::ClusterPlace> places;
    std::uint64_t count = 0;
    for (const NodeRecord& node : log().nodes(round.number))
        count += node.pending.clusters;
    places.reserve(count);
    std::vector<std::byte> bytes;
    for (const NodeRecord& node : log().nodes(round.number)) {
        bytes.resize(levels::placeBytes(node.pending.clusters));
        leftFile_->read(node.pendingOffset, bytes);
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
    record.scratchEnd = binsFile_->end();
    record.directory = bins_->directory();
    return record;
}

void RoundBins::routeAll(const Round& round, const BinningMeans& means, const ClusterPlan& plan, LockCounts& locks) {
    const std::vector<NodeRecord>& nodes = log().nodes(round.number);
    const auto nodeCount = static_cast<std::uint32_t>(plan.nodes.size());
    const std::uint32_t streams = nodeCount * static_cast<std::uint32_t>(Stream::Count);
    std::vector<std::size_t> firstCluster(1, 0); // of each old node
    Bytes most;
    for (const NodeRecord& node : nodes) {
        firstCluster.push_back(firstCluster.back() + node.pending.clusters);
        most = std::max(most, MemoryNeeds::routing(node.pendingBytes, node.pending.vertices));
    }
    const BorderShare share = borderShare(std::max(means.room, most), most, means.threads);
    bins_.emplace(*binsFile_, streams, blockBytes(share.blocks, std::max(streams, 1U)));
    const auto append = [&](Stream kind, const StreamBytes& messages) {
        for (const auto& [node, bytes] : messages)
            bins_->append(chunk::streamOf(kind, node), bytes);
    };
    chunk::makeInOrder(
        0,
        nodes.size(),
        share.chunksAtOnce,
        [&](std::size_t node) {
            std::vector<std::byte> bytes(nodes[node].pendingBytes);
            if (!bytes.empty()) leftFile_->read(nodes[node].pendingOffset, bytes);
            return routed(
                {bytes,
                 std::span(plan.nodeOf).subspan(firstCluster[node], nodes[node].pending.clusters),
                 nodes[node].firstLevel,
                 log().firstPages(round.number, node)},
                nodeCount);
        },
        [&](std::size_t, const RoutedClusters& clusters) {
            append(Stream::Records, clusters.records);
            append(Stream::Locks, clusters.locks);
            append(Stream::Borders, clusters.borders);
            locks.locked += clusters.counts.locked;
            progress_.advance(0);
        });
    bins_->flush();
    shareBorders(nodeCount, share.chunksAtOnce, locks);
}

void RoundBins::shareBorders(std::uint32_t nodeCount, std::size_t atOnce, LockCounts& locks) {
    struct Shared {
        StreamBytes locks;
        LockCounts counts;
    };

    chunk::makeInOrder(
        0,
        nodeCount,
        atOnce,
        [&](std::size_t stream) {
            Shared shared;
            shared.locks = sharedBorders(
                bins_->readAs<BorderUse>(chunk::streamOf(Stream::Borders, static_cast<std::uint32_t>(stream))),
                shared.counts);
            return shared;
        },
        [&](std::size_t, const Shared& shared) {
            for (const auto& [node, bytes] : shared.locks)
                bins_->append(chunk::streamOf(Stream::Locks, node), bytes);
            locks.locked += shared.counts.locked;
            locks.lockedBefore += shared.counts.lockedBefore;
            progress_.advance(0);
        });
    bins_->flush();
    for (std::uint32_t node = 0; node < nodeCount; ++node)
        bins_->release(chunk::streamOf(Stream::Borders, node));
}

levels::PendingLevel RoundBins::load(std::uint32_t node) const {
    const ClusterSums& sums = log().binnedRound(round_)->nodes[node];
    levels::PendingLevelMerger merger(
        log().binned()->grid, sums.clusters, sums.vertices, log().binned()->format.fields);
    bins_->readBlocks(
        chunk::streamOf(Stream::Records, node), [&](std::span<const std::byte> records) { merger.add(records); });
    bins_->readBlocks(chunk::streamOf(Stream::Locks, node), [&](std::span<const std::byte> locks) {
        for (const hierarchy::GridPoint& position : levels::positionsFrom(locks))
            merger.lock(position);
    });
    return merger.take();
}

void RoundBins::release(std::uint32_t node) {
    for (const Stream kind : {Stream::Records, Stream::Locks})
        bins_->release(chunk::streamOf(kind, node));
}

void RoundBins::releaseLeft(const Round& round) {
    for (const NodeRecord& node : log().nodes(round.number))
        leftFile_->release(node.pendingOffset, node.pendingBytes);
}

} // namespace gnomon::pipeline
