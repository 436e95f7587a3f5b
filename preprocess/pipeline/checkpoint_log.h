// The checkpoint log of a build. It contains a record of each finished step, from which another process can resume the
// build.
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

/// The version of the records in the checkpoint log. It increases when their format changes. A build can only resume
/// records of the same version.
constexpr int kCheckpointVersion = 12;

/// The numbers of source triangles that the build dropped: degenerate, doubled, collapsed by the grid, and (partly or
/// wholly) covered by earlier coplanar triangles.
using DroppedCounts = std::array<std::uint64_t, 4>;

/// The number of byte streams per node, a part of the model, in rounds after the first (round_bins.h).
constexpr std::uint32_t kStreamsOfNode = 3;

/// The checkpoint after the first phase of a build, which sorts the source into chunks.
struct BinnedRecord {
    hierarchy::Grid grid;
    hierarchy::GridPoint furthest; // max grid coordinates of the positions
    Box mainPart;                  // bounds of the source without strays (triangles far outside)
    double medianEdge = 0;
    chunk::Strayed strayed;
    chunk::VertexFormat format;
    std::vector<hierarchy::Field> fields;
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    std::uint64_t notAPolygon = 0;
    std::uint64_t badNormals = 0; // number of invalid normals, if the summary of the source does not count them
    std::uint32_t chunkCount = 0;
    chunk::PartSize largestChunk;
    DroppedCounts dropped{};          // numbers of triangles that were dropped before the sorting
    std::vector<std::byte> directory; // StreamStore::directory of the chunks' streams
};

/// The checkpoint after the chunks have sent each other the vertices and normals that they share.
struct BorderedRecord {
    std::vector<std::byte> directory;
};

/// The checkpoint after one part of the model (a node) was built in a round.
struct NodeRecord {
    struct LevelOfNode {
        hierarchy::LevelInfo info;
        /// Rows of the page table, whose offsets are offsets in the scratch file. The children of a page are
        /// provisional ids. In a new record, the page numbers of the node's own levels start at 0. When the record is
        /// in `nodes`, they start at the node's first page of the level.
        std::vector<hierarchy::PageInfo> pages;
    };

    std::uint32_t round = 0;
    std::uint32_t node = 0;
    std::uint32_t firstLevel = 0;
    std::vector<LevelOfNode> levels;
    scratch::Block places;   // ClusterPlaces of the clusters that have no groups yet
    scratch::Block clusters; // records of the clusters that have no groups yet
    ClusterSums pending;     // totals of the clusters that have no groups yet
    std::uint64_t rootTriangles = 0;
    std::uint64_t irreducibleTriangles = 0;
    DroppedCounts dropped{};
    Box bounds;              // bounds of the chunk; only in round 0
    bool hasNormals = false; // whether the chunk has normals; only in round 0
};

/// The checkpoint after the clusters for a new round have been sorted. The clusters without groups of the previous
/// round are then in the streams of the new round's nodes.
struct RoundRecord {
    std::uint32_t round = 0; // number of the round, at least 1
    bool isLast = false;
    std::vector<ClusterSums> nodes;
    LockCounts locks;
    std::vector<std::byte> directory;
};

/// All checkpoints of a build. The first record of the file contains the key of the build.
class CheckpointLog {
public:
    const std::optional<BinnedRecord>& binned() const { return binned_; }

    const std::optional<BorderedRecord>& bordered() const { return bordered_; }

    /// Returns the record that the clusters for `round` were sorted, or null if they were not. If a round has a record,
    /// all earlier rounds from 1 on have one too.
    const RoundRecord* binnedRound(std::uint32_t round) const;

    /// Returns the records of the finished nodes (parts of the model) of `round`, in order. The list ends before the
    /// first unfinished node.
    const std::vector<NodeRecord>& nodes(std::uint32_t round) const;

    /// Returns true if the part `node` of the model is finished in `round`. Earlier nodes of the round may still be
    /// unfinished.
    bool isBuilt(std::uint32_t round, std::uint32_t node) const;

    /// Returns the number of triangles in all levels of the nodes of `round` that are finished.
    std::uint64_t builtTriangles(std::uint32_t round) const;

    std::uint32_t roundCount() const { return static_cast<std::uint32_t>(rounds_.size()); }

    /// Returns the number of pages of each level so far, finest level first.
    const std::vector<std::uint32_t>& pageCounts() const { return pageCounts_; }

    /// Returns the page number of a node's first page for each of its levels: firstLevel, firstLevel + 1, ... The pages
    /// of earlier nodes precede the node's pages.
    const std::vector<std::uint32_t>& firstPages(std::uint32_t round, std::size_t node) const {
        return firstPages_[round][node];
    }

    /// Reserves memory for the records of all nodes of one round. Other threads can then read existing records while
    /// this thread adds new records.
    void beginRound(std::uint32_t round);

    void add(BinnedRecord record) { binned_ = std::move(record); }

    void add(BorderedRecord record) { bordered_ = std::move(record); }

    void add(RoundRecord record);

    /// Adds the record of a finished node. The nodes of a round may be added in any order. Throws Damage if the node
    /// was added before.
    void add(NodeRecord record);

    /// Throws Damage if the records contradict each other, for example if streams, nodes or pages are missing.
    void requireConsistent() const;

    /// Returns for each scratch file (part) how many bytes the records use, counted from the start of the file. Throws
    /// Damage if a block exceeds its file or overlaps another block.
    std::map<std::uint32_t, std::uint64_t> scratchBytes() const;

    /// Decodes a record that `encoded` returned and adds it to the log. Throws Damage if the bytes are malformed.
    void addEncoded(std::span<const std::byte> record);

private:
    void append(NodeRecord record);
    void requireChildren(const NodeRecord& node) const;

    std::optional<BinnedRecord> binned_;
    std::optional<BorderedRecord> bordered_;
    std::vector<RoundRecord> binnedRounds_; // from round 1 on
    std::vector<std::vector<NodeRecord>> rounds_;
    // per round: records of finished nodes that follow an unfinished node
    std::vector<std::map<std::uint32_t, NodeRecord>> early_;
    std::vector<std::vector<std::vector<std::uint32_t>>> firstPages_;
    std::vector<std::uint32_t> pageCounts_;
};

/// Encodes a checkpoint record as bytes.
std::vector<std::byte> encoded(const BinnedRecord& record);
std::vector<std::byte> encoded(const BorderedRecord& record);
std::vector<std::byte> encoded(const RoundRecord& record);
std::vector<std::byte> encoded(const NodeRecord& record);

/// Returns the numbers of the scratch files (parts) that contain the blocks of `record`, in ascending order.
std::vector<std::uint32_t> partsOf(const BinnedRecord& record);
std::vector<std::uint32_t> partsOf(const BorderedRecord& record);
std::vector<std::uint32_t> partsOf(const RoundRecord& record);
std::vector<std::uint32_t> partsOf(const NodeRecord& record);

/// Decodes the record of a finished node. Throws Damage if the bytes are malformed.
NodeRecord decodedNode(std::span<const std::byte> record);

} // namespace gnomon::pipeline
