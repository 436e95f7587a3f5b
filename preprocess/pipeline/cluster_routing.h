// One finished node's clusters on their way to the nodes of the next round, and what these share.
#pragma once

#include "preprocess/levels/pending_level.h"

#include <map>
#include <span>
#include <vector>

namespace gnomon::pipeline {

/// Bytes for each stream of a kind.
using StreamBytes = std::map<std::uint32_t, std::vector<std::byte>>;

/// That a node of the next round got a cluster with this position, which was a border in the round before.
struct BorderUse {
    hierarchy::GridPoint position;
    std::uint32_t node = 0;
    auto operator<=>(const BorderUse&) const = default;
};

/// How many positions are locked, and how many of these were in the round before.
struct LockCounts {
    std::uint64_t locked = 0;
    std::uint64_t lockedBefore = 0;
};

/// What a node hands on.
struct RoutedClusters {
    StreamBytes records; // by new node
    StreamBytes locks;   // by new node: positions that were no borders and that several new nodes use now
    StreamBytes borders; // BorderUse by the hash of the position, modulo the number of streams
    LockCounts counts;   // of `locks`
};

/// The clusters that a node left in a round.
struct LeftClusters {
    std::span<const std::byte> bytes;          // EncodedPendingLevel
    std::span<const std::uint32_t> nodeOf;     // of each of its clusters, in the next round
    std::uint32_t firstLevel = 0;              // of the node, and ...
    std::span<const std::uint32_t> firstPages; // ... the number of its first page of each level
};

/// Parts what a node left by the new nodes, and what these share by `borderStreams` streams.
RoutedClusters routed(const LeftClusters& left, std::uint32_t borderStreams);

/// The positions that several nodes use of one stream of BorderUse, by node.
StreamBytes sharedBorders(std::vector<BorderUse> uses, LockCounts& counts);

} // namespace gnomon::pipeline
