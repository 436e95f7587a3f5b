// Sends the clusters of a finished node to the nodes of the next round. It also finds the positions that several of
// these nodes share.
#pragma once

#include "preprocess/levels/open_clusters.h"

#include <map>
#include <span>
#include <vector>

namespace gnomon::pipeline {

/// Bytes to append to streams, by the number of the stream. All streams are of one kind.
using StreamBytes = std::map<std::uint32_t, std::vector<std::byte>>;

/// The fact that a node of the next round has a cluster with this position. The position was on a border in the
/// previous round.
struct BorderUse {
    hierarchy::GridPoint position;
    std::uint32_t node = 0;
    auto operator<=>(const BorderUse&) const = default;
};

/// The number of locked positions in a round, and how many of them were also locked in the previous round.
struct LockCounts {
    std::uint64_t locked = 0;
    std::uint64_t lockedBefore = 0;
};

/// The clusters and border positions of a finished node, sorted by their destination in the next round.
struct RoutedClusters {
    StreamBytes records; // per node of the next round: encoded clusters
    StreamBytes locks;   // per node of the next round: positions that are shared for the first time
    // For each border stream, the BorderUse records of its positions. The stream number is the hash of the position
    // modulo the number of streams.
    StreamBytes borders;
    LockCounts counts; // numbers of positions in `locks`
};

/// The clusters of a finished node (part of the model) that have no groups yet.
struct LeftClusters {
    std::span<const std::byte> bytes;          // encoded EncodedOpenClusters
    std::span<const std::uint32_t> nodeOf;     // per cluster: index of its node in the next round
    std::uint32_t firstLevel = 0;              // first level of detail that the node built
    std::span<const std::uint32_t> firstPages; // for each level, the number of the node's first page
};

/// Distributes the clusters `left` of a finished node to the nodes of the next round. Distributes the uses of border
/// positions to `borderStreams` streams.
RoutedClusters routed(const LeftClusters& left, std::uint32_t borderStreams);

/// Returns for each node of the next round the positions in `uses` that several nodes use. `uses` contains all records
/// of one border stream. The function adds the numbers of these positions to `counts`.
StreamBytes sharedBorders(std::vector<BorderUse> uses, LockCounts& counts);

} // namespace gnomon::pipeline
