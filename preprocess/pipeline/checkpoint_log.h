// The checkpoint log: what a build has finished so far, and the records from which another process can resume it.
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

/// Triangles of the source that are left out: degenerate, doubled, collapsed by the grid, and those that earlier ones
/// cover in the same plane, wholly or in part.
using DroppedCounts = std::array<std::uint64_t, 4>;

/// The streams of a node of a round after the first (round_bins.h).
constexpr std::uint32_t kStreamsOfNode = 3;

/// The source is in chunks.
struct BinnedRecord {
    hierarchy::Grid grid;
    hierarchy::GridPoint furthest; // of the positions, on each axis
    Box mainPart;                  // of the source, without strays
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
    DroppedCounts dropped{};          // before the chunks
    std::vector<std::byte> directory; // of the store
};

/// The chunks know their borders.
struct BorderedRecord {
    std::vector<std::byte> directory;
};

/// One node of a round is built.
struct NodeRecord {
    struct LevelOfNode {
        hierarchy::LevelInfo info;
        /// Offsets in the scratch file, children as provisional ids: of this node's levels, pages are counted from the
        /// node's own first until the record is among `nodes`, then from the level's.
        std::vector<hierarchy::PageInfo> pages;
    };

    std::uint32_t round = 0;
    std::uint32_t node = 0;
    std::uint32_t firstLevel = 0;
    std::vector<LevelOfNode> levels;
    scratch::Block places;   // of the clusters that are left, and ...
    scratch::Block clusters; // ... these
    ClusterSums pending;     // their sums
    std::uint64_t rootTriangles = 0;
    std::uint64_t stuckTriangles = 0;
    DroppedCounts dropped{};
    Box bounds;              // of the chunk, in round 0
    bool hasNormals = false; // of the chunk, in round 0
};

/// The clusters that the round before left are in the streams of a round's nodes.
struct RoundRecord {
    std::uint32_t round = 0; // from 1 on
    bool isLast = false;
    std::vector<ClusterSums> nodes;
    LockCounts locks;
    std::vector<std::byte> directory;
};

/// All of a build's records. The first is a text that says what is built from what.
class CheckpointLog {
public:
    const std::optional<BinnedRecord>& binned() const { return binned_; }

    const std::optional<BorderedRecord>& bordered() const { return bordered_; }

    /// That of `round`, if it is there: they come in order, without gaps.
    const RoundRecord* binnedRound(std::uint32_t round) const;

    /// The nodes that are built of `round`, in order, up to the first that is not.
    const std::vector<NodeRecord>& nodes(std::uint32_t round) const;

    /// Whether a node is built, be it that others before it are not.
    bool isBuilt(std::uint32_t round, std::uint32_t node) const;

    /// The triangles of all levels that the built nodes of `round` have.
    std::uint64_t builtTriangles(std::uint32_t round) const;

    std::uint32_t roundCount() const { return static_cast<std::uint32_t>(rounds_.size()); }

    /// Pages so far of each level, finest first.
    const std::vector<std::uint32_t>& pageCounts() const { return pageCounts_; }

    /// How many pages of the node's levels precede its own: of levels firstLevel, firstLevel + 1, ...
    const std::vector<std::uint32_t>& firstPages(std::uint32_t round, std::size_t node) const {
        return firstPages_[round][node];
    }

    /// Makes room for a round, after which `nodes` of the others may be read while nodes are added to this one.
    void beginRound(std::uint32_t round);

    void add(BinnedRecord record) { binned_ = std::move(record); }

    void add(BorderedRecord record) { bordered_ = std::move(record); }

    void add(RoundRecord record);

    /// In any order within a round. Throws Damage for a node that is there already.
    void add(NodeRecord record);

    /// Throws Damage if records do not belong together: streams, nodes or pages that are not there.
    void requireConsistent() const;

    /// Returns how many bytes of each part of the scratch file the records name, counted from its begin. Throws Damage
    /// if blocks do not fit into a part, or share bytes.
    std::map<std::uint32_t, std::uint64_t> scratchBytes() const;

    /// Adds what `encoded` returned. Throws Damage.
    void addEncoded(std::span<const std::byte> record);

private:
    void append(NodeRecord record);
    void requireChildren(const hierarchy::PageInfo& page) const;

    std::optional<BinnedRecord> binned_;
    std::optional<BorderedRecord> bordered_;
    std::vector<RoundRecord> binnedRounds_; // from round 1 on
    std::vector<std::vector<NodeRecord>> rounds_;
    std::vector<std::map<std::uint32_t, NodeRecord>> early_; // of each round: those that wait for nodes before them
    std::vector<std::vector<std::vector<std::uint32_t>>> firstPages_;
    std::vector<std::uint32_t> pageCounts_;
};

std::vector<std::byte> encoded(const BinnedRecord& record);
std::vector<std::byte> encoded(const BorderedRecord& record);
std::vector<std::byte> encoded(const RoundRecord& record);
std::vector<std::byte> encoded(const NodeRecord& record);

/// Returns the parts of the scratch file that have the blocks of `record`, ascending.
std::vector<std::uint32_t> partsOf(const BinnedRecord& record);
std::vector<std::uint32_t> partsOf(const BorderedRecord& record);
std::vector<std::uint32_t> partsOf(const RoundRecord& record);
std::vector<std::uint32_t> partsOf(const NodeRecord& record);

/// What `encoded` made of a node's record. Throws Damage.
NodeRecord decodedNode(std::span<const std::byte> record);

} // namespace gnomon::pipeline
