// Sends the clusters of a finished node to the nodes of the next round, and finds the positions that several of these
// nodes share.
#pragma once

#include "preprocess/levels/open_clusters.h"

#include <map>
#include <span>
#include <vector>

namespace gnomon::pipeline {

/// Bytes per stream number, for streams of one kind.
using StreamBytes = std::map<std::uint32_t, std::vector<std::byte>>;

/// One use of a position: a node of the next round has a cluster with this position. The position was a border in the
/// previous round.
struct BorderUse {
    hierarchy::GridPoint position;
    std::uint32_t node = 0;
    auto operator<=>(const BorderUse&) const = default;
};

/// The number of locked positions of a round, and how many of them were also locked in the previous round.
struct LockCounts {
    std::uint64_t locked = 0;
    std::uint64_t lockedBefore = 0;
};

/// The result of routing the clusters of a node.
struct RoutedClusters {
    StreamBytes records; // per node of the next round: records of its clusters
    StreamBytes locks;   // per node of the next round: positions that are shared for the first time
    // BorderUse records per border stream. The stream of a position is the hash of the position modulo the number of
    // streams.
    StreamBytes borders;
    LockCounts counts; // numbers of positions in `locks`
};

/// The clusters without groups that a node has after a round.
struct LeftClusters {
    std::span<const std::byte> bytes;          // encoded EncodedOpenClusters
    std::span<const std::uint32_t> nodeOf;     // per cluster: its node in the next round
    std::uint32_t firstLevel = 0;              // first level that the node built
    std::span<const std::uint32_t> firstPages; // per level: number of the node's first page
};

/// Distributes the clusters of a node to the nodes of the next round. Distributes the uses of its border positions to
/// `borderStreams` streams.
RoutedClusters routed(const LeftClusters& left, std::uint32_t borderStreams);

/// Returns per node of the next round the positions of `uses` that several nodes use. `uses` contains all records of
/// one border stream. The function adds to `counts`.
StreamBytes sharedBorders(std::vector<BorderUse> uses, LockCounts& counts);

} // namespace gnomon::pipeline
