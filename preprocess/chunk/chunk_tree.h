// Which chunk each place of the grid belongs to: an adaptive octree of counts, cut along its space-filling order.
#pragma once

#include "preprocess/simplify/mesh.h"

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::chunk {

/// The most chunks of a model: with 32 bits for the streams that each has several of.
constexpr std::uint32_t kMaxChunks = (1U << 29U) - 1;

/// As many chunks have numbers of 16 bits.
constexpr std::uint32_t kNarrowChunks = 0xFFFF;

/// The chunk of vertices beyond the grid's range, which no chunk contains. In 16 bits it is 0xFFFF.
constexpr std::uint32_t kBeyondGrid = 0xFFFFFFFF;

/// For CellCounts of the vertices of a source, of which each thread has one: the first cells of a small one are few.
int rootBitsFor(std::uint64_t vertices);

/// Weights by cell of the grid; cells that turn out too heavy are counted again in smaller ones.
///
///     CellCounts counts(furthest);
///     do { for each vertex: counts.add(point, weight); } while (counts.refine(limit));
class CellCounts {
public:
    static constexpr int kMostRootBits = 7;

    /// For points up to `furthest` on each axis. The first cells are 2^`rootBits` to a side, at most 7; it changes how
    /// often points are counted again, and nothing else.
    explicit CellCounts(const hierarchy::GridPoint& furthest, int rootBits = kMostRootBits);

    /// Counts `weight` where it is still unknown: in the cells made by the last `refine`.
    void add(const hierarchy::GridPoint& point, std::uint32_t weight);

    /// Cuts cells above `limit` that are larger than a point into smaller ones. Whether there are any: then everything
    /// must be added again.
    bool refine(std::uint64_t limit);

    /// How the cells are cut: what another process counts into the same cells with.
    std::vector<std::byte> shape() const;

    /// The cells of `shape`, with `furthest` and `rootBits` as there, all without weight. Throws hierarchy::Damage.
    CellCounts(const hierarchy::GridPoint& furthest, std::span<const std::byte> shape, int rootBits = kMostRootBits);

    /// The weights of the cells that are still unknown, and how to add them to those here, where the cells are cut
    /// likewise. Throws hierarchy::Damage.
    std::vector<std::byte> openWeights() const;
    void addOpenWeights(std::span<const std::byte> weights);

    /// The points of more weight than `limit`, after the last `refine` of it.
    std::vector<hierarchy::GridPoint> pointsAbove(std::uint64_t limit) const;

private:
    friend class ChunkTree;

    /// Cells of one size under one parent, in Morton order (first bit x, then y, then z).
    struct Table {
        int bits = 0;  // of each coordinate that tell the cell
        int shift = 0; // bits of each coordinate below them
        std::vector<std::uint64_t> weights;
        std::vector<std::int32_t> finer; // table of the cell's own cells, or -1; empty until there is one
    };

    /// Of each table from the second on: the cell that it cuts.
    struct Parent {
        std::uint32_t table = 0;
        std::uint32_t cell = 0;
    };

    static std::int32_t finerThan(const Table& table, std::size_t cell) {
        return table.finer.empty() ? -1 : table.finer[cell];
    }

    void cut(const Parent& parent);
    static Table makeTable(int bits, int shift);
    static std::uint32_t cellOf(const Table& table, const hierarchy::GridPoint& point);
    void collectAbove(
        std::uint64_t limit,
        std::size_t table,
        const hierarchy::GridPoint& corner,
        std::vector<hierarchy::GridPoint>& points) const;

    std::vector<Table> tables_;
    std::vector<Parent> parents_;
    std::size_t firstOpen_ = 0;
};

/// The finished tree.
class ChunkTree {
public:
    /// Cuts the cells, in Morton order, into chunks of at most `limit` weight each; a cell is left whole where its
    /// weight is at most an eighth of that. Only a cell of a single point can weigh more than a chunk may.
    ChunkTree(const CellCounts& counts, std::uint64_t limit);

    /// What `encoded` made, without its heavy points. Throws hierarchy::Damage.
    explicit ChunkTree(std::span<const std::byte> bytes);
    std::vector<std::byte> encoded() const;

    std::uint32_t chunkCount() const { return static_cast<std::uint32_t>(weights_.size()); }

    /// The points that weigh more than an eighth of a chunk.
    const std::vector<hierarchy::GridPoint>& heavyPoints() const { return heavyPoints_; }

    /// The chunk of a point that was counted.
    std::uint32_t chunkOf(const hierarchy::GridPoint& point) const;

private:
    struct Table {
        int bits = 0;
        int shift = 0;
        std::vector<std::uint32_t> chunks; // per cell; from kFiner on, a table
    };

    static constexpr std::uint32_t kFiner = 0x80000000U;

    void cut(const CellCounts& counts, std::size_t table, std::size_t begin, std::size_t end, std::uint64_t limit);
    void assign(std::size_t table, std::size_t begin, std::size_t end);

    std::vector<Table> tables_;
    std::vector<std::uint64_t> weights_; // of each chunk
    std::vector<hierarchy::GridPoint> heavyPoints_;
};

} // namespace gnomon::chunk
