// Routes the clusters of one finished node to the nodes of the next round, and finds the shared positions of these
// nodes.
#pragma once

#include "preprocess/levels/open_clusters.h"

#include <map>
#include <span>
#include <vector>

namespace gnomon::pipeline {

/// Bytes per stream of one kind.
using StreamBytes = std::map<std::uint32_t, std::vector<std::byte>>;

/// A use of a position: a node of the next round has a cluster at this position, which was a border in the previous
/// round.
struct BorderUse {
    hierarchy::GridPoint position;
    std::uint32_t node = 0;
    auto operator<=>(const BorderUse&) const = default;
};

/// The number of locked positions, and how many of them were also locked in the previous round.
struct LockCounts {
    std::uint64_t locked = 0;
    std::uint64_t lockedBefore = 0;
};

/// The output of the routing of a node.
struct RoutedClusters {
    StreamBytes records; // per new node
    StreamBytes locks;   // per new node: positions that were not borders, and that several new nodes use now
    // BorderUse per stream; the hash of the position modulo the number of streams selects the stream.
    StreamBytes borders;
    LockCounts counts; // counts of `locks`
};

/// The remaining clusters of a node after a round.
struct LeftClusters {
    std::span<const std::byte> bytes;          // EncodedOpenClusters
    std::span<const std::uint32_t> nodeOf;     // node in the next round, per cluster
    std::uint32_t firstLevel = 0;              // first level of the node
    std::span<const std::uint32_t> firstPages; // number of its first page in each level
};

/// Distributes the clusters of a node to the new nodes, and its border positions to `borderStreams` streams.
RoutedClusters routed(const LeftClusters& left, std::uint32_t borderStreams);

/// Returns the positions of one stream of BorderUse that several nodes use, per node.
StreamBytes sharedBorders(std::vector<BorderUse> uses, LockCounts& counts);

} // namespace gnomon::pipeline
