// The checkpoint log: the finished steps of a build, and the records from which another process can resume it.
#pragma once

#include "hierarchy/model.h"
#include "preprocess/chunk/chunk_streams.h"
#include "preprocess/pipeline/cluster_plan.h"
#include "preprocess/pipeline/cluster_routing.h"

#include <array>
#include <map>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace gnomon::pipeline {

/// Counts up when the records change: a build can go on only with those of its own kind.
constexpr int kCheckpointVersion = 12;

/// The numbers of dropped source triangles: degenerate, doubled, collapsed by the grid, and (partly or wholly) covered
/// by earlier coplanar triangles.
using DroppedCounts = std::array<std::uint64_t, 4>;

/// The number of streams of a node of a round after the first (round_bins.h).
constexpr std::uint32_t kStreamsOfNode = 3;

/// The record of a finished binning: the source is in chunks.
struct BinnedRecord {
    hierarchy::Grid grid;
    hierarchy::GridPoint furthest; // max coordinates of the positions
    Box mainPart;                  // main part of the source, without strays
    double medianEdge = 0;
    chunk::Strayed strayed;
    chunk::VertexFormat format;
    std::vector<hierarchy::Field> fields;
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    std::uint64_t notAPolygon = 0;
    std::uint64_t badNormals = 0; // that the source's summary does not count
    std::uint32_t chunkCount = 0;
    chunk::PartSize largestChunk;
    DroppedCounts dropped{};          // dropped before the chunks
    std::vector<std::byte> directory; // directory of the store
};

/// The record of the finished border exchange between chunks.
struct BorderedRecord {
    std::vector<std::byte> directory;
};

/// The record of a finished node of a round.
struct NodeRecord {
    struct LevelOfNode {
        hierarchy::LevelInfo info;
        /// Pages with offsets in the scratch file. Children are provisional ids. In a new record, page numbers of the
        /// node's own levels start at 0. After the record is in `nodes`, they start at the node's first page of the
        /// level.
        std::vector<hierarchy::PageInfo> pages;
    };

    std::uint32_t round = 0;
    std::uint32_t node = 0;
    std::uint32_t firstLevel = 0;
    std::vector<LevelOfNode> levels;
    scratch::Block places;   // places of the remaining clusters
    scratch::Block clusters; // the remaining clusters
    ClusterSums pending;     // their sums
    std::uint64_t rootTriangles = 0;
    std::uint64_t irreducibleTriangles = 0;
    DroppedCounts dropped{};
    Box bounds;              // bounds of the chunk, in round 0
    bool hasNormals = false; // whether the chunk has normals, in round 0
};

/// The record of a binned round: the remaining clusters of the previous round are in the streams of the new nodes.
struct RoundRecord {
    std::uint32_t round = 0; // from 1 on
    bool isLast = false;
    std::vector<ClusterSums> nodes;
    LockCounts locks;
    std::vector<std::byte> directory;
};

/// All records of a build. The first record of the file is the key of the build.
class CheckpointLog {
public:
    const std::optional<BinnedRecord>& binned() const { return binned_; }

    const std::optional<BorderedRecord>& bordered() const { return bordered_; }

    /// Returns the record of `round`, or null. The records of rounds are contiguous.
    const RoundRecord* binnedRound(std::uint32_t round) const;

    /// Returns the built nodes of `round`, in order, up to the first unfinished node.
    const std::vector<NodeRecord>& nodes(std::uint32_t round) const;

    /// Returns true if a node is built. Nodes before it may be unfinished.
    bool isBuilt(std::uint32_t round, std::uint32_t node) const;

    /// Returns the number of triangles of all levels in the built nodes of `round`.
    std::uint64_t builtTriangles(std::uint32_t round) const;

    std::uint32_t roundCount() const { return static_cast<std::uint32_t>(rounds_.size()); }

    /// Returns the current number of pages of each level, finest level first.
    const std::vector<std::uint32_t>& pageCounts() const { return pageCounts_; }

    /// Returns the number of pages that precede the node's pages, for the levels firstLevel, firstLevel + 1, ...
    const std::vector<std::uint32_t>& firstPages(std::uint32_t round, std::size_t node) const {
        return firstPages_[round][node];
    }

    /// Reserves memory for all nodes of one round. Other threads can then read existing nodes while this thread adds
    /// new nodes.
    void beginRound(std::uint32_t round);

    void add(BinnedRecord record) { binned_ = std::move(record); }

    void add(BorderedRecord record) { bordered_ = std::move(record); }

    void add(RoundRecord record);

    /// Adds a node, in any order within a round. Throws Damage if the node was added before.
    void add(NodeRecord record);

    /// Throws Damage if the records are inconsistent: missing streams, nodes or pages.
    void requireConsistent() const;

    /// Returns the number of bytes that the records use in each part of the scratch file, counted from the start of the
    /// part. Throws Damage if blocks exceed a part or overlap.
    std::map<std::uint32_t, std::uint64_t> scratchBytes() const;

    /// Adds a record that `encoded` returned. Throws Damage.
    void addEncoded(std::span<const std::byte> record);

private:
    void append(NodeRecord record);
    void requireChildren(const NodeRecord& node) const;

    std::optional<BinnedRecord> binned_;
    std::optional<BorderedRecord> bordered_;
    std::vector<RoundRecord> binnedRounds_; // from round 1 on
    std::vector<std::vector<NodeRecord>> rounds_;
    std::vector<std::map<std::uint32_t, NodeRecord>> early_; // per round: finished nodes that wait for earlier nodes
    std::vector<std::vector<std::vector<std::uint32_t>>> firstPages_;
    std::vector<std::uint32_t> pageCounts_;
};

/// Encodes a record as bytes.
std::vector<std::byte> encoded(const BinnedRecord& record);
std::vector<std::byte> encoded(const BorderedRecord& record);
std::vector<std::byte> encoded(const RoundRecord& record);
std::vector<std::byte> encoded(const NodeRecord& record);

/// Returns the parts of the scratch file that contain the blocks of `record`, in ascending order.
std::vector<std::uint32_t> partsOf(const BinnedRecord& record);
std::vector<std::uint32_t> partsOf(const BorderedRecord& record);
std::vector<std::uint32_t> partsOf(const RoundRecord& record);
std::vector<std::uint32_t> partsOf(const NodeRecord& record);

/// Decodes the record of a node. Throws Damage.
NodeRecord decodedNode(std::span<const std::byte> record);

} // namespace gnomon::pipeline
