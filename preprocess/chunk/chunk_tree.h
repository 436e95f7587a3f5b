// Which chunk each place of the grid belongs to: an adaptive octree of counts, cut along its space-filling order.
#pragma once

#include "preprocess/simplify/mesh.h"

#include <vector>

namespace gnomon::chunk {

/// The most chunks of a model: their ids have 16 bits.
constexpr std::uint32_t kMaxChunks = 0xFFFF;

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

    /// The points of more weight than `limit`, after the last `refine` of it.
    std::vector<hierarchy::GridPoint> pointsAbove(std::uint64_t limit) const;

private:
    friend class ChunkTree;

    /// Cells of one size under one parent, in Morton order (first bit x, then y, then z).
    struct Table {
        int bits = 0;  // of each coordinate that tell the cell
        int shift = 0; // bits of each coordinate below them
        std::vector<std::uint64_t> weights;
        std::vector<std::int32_t> finer; // table of the cell's own cells, or -1
    };

    static Table makeTable(int bits, int shift);
    static std::uint32_t cellOf(const Table& table, const hierarchy::GridPoint& point);
    void collectAbove(
        std::uint64_t limit,
        std::size_t table,
        const hierarchy::GridPoint& corner,
        std::vector<hierarchy::GridPoint>& points) const;

    std::vector<Table> tables_;
    std::size_t firstOpen_ = 0;
};

/// The finished tree.
class ChunkTree {
public:
    /// Cuts the cells, in Morton order, into chunks of at most `limit` weight each; a cell is left whole where its
    /// weight is at most an eighth of that. Only a cell of a single point can weigh more than a chunk may.
    ChunkTree(const CellCounts& counts, std::uint64_t limit);

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
