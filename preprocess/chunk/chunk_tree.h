// Assigns grid points to chunks with an adaptive octree. Each octree cell has a weight. A chunk is a run of cells in
// Morton order.
#pragma once

#include "preprocess/simplify/mesh.h"

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::chunk {

/// The max number of chunks of a model. Stream numbers have 32 bits, and each chunk has several streams.
constexpr std::uint32_t kMaxChunks = (1U << 29U) - 1;

/// The max number of chunks whose numbers fit into 16 bits.
constexpr std::uint32_t kNarrowChunks = 0xFFFF;

/// The chunk number of a vertex outside the range of the grid. No chunk contains such vertices. As a 16-bit number it
/// is 0xFFFF.
constexpr std::uint32_t kOutsideGrid = 0xFFFFFFFF;

/// Returns log2 of the number of root cells per axis that CellCounts uses for a source with `vertices` vertices. A
/// small source uses few root cells, because each thread has its own CellCounts.
int rootBitsFor(std::uint64_t vertices);

/// Counts weights per octree cell of the grid. The class divides cells that are too heavy, and the caller then adds the
/// points again:
///
///     CellCounts counts(furthest);
///     do { for each vertex: counts.add(point, weight); } while (counts.refine(limit));
class CellCounts {
public:
    static constexpr int kMaxRootBits = 7;

    /// Creates octree cells for points with coordinates up to those of `furthest`. The root cells form a grid of
    /// 2^`rootBits` cells per axis. `rootBits` is at most 7. It affects only the number of counting passes, not the
    /// result.
    explicit CellCounts(const hierarchy::GridPoint& furthest, int rootBits = kMaxRootBits);

    /// Adds `weight` to the octree cell that contains `point`, if the last call of `refine` created this cell (an open
    /// cell).
    void add(const hierarchy::GridPoint& point, std::uint32_t weight);

    /// Divides the octree cells that are heavier than `limit`, except cells of a single grid point. Returns true if it
    /// divided a cell. The caller must then add all points again.
    bool refine(std::uint64_t limit);

    /// Returns the division of the grid into octree cells, encoded as bytes. Another process can then count into the
    /// same cells.
    std::vector<std::byte> shape() const;

    /// Creates the octree cells that `shape` encodes, with zero weights. `furthest` and `rootBits` must be the same as
    /// in the process that called `shape()`. Throws hierarchy::Damage if the bytes are malformed.
    CellCounts(const hierarchy::GridPoint& furthest, std::span<const std::byte> shape, int rootBits = kMaxRootBits);

    /// Returns the weights of the open cells, which the last `refine` created, as bytes. `addOpenWeights` adds these
    /// weights to the same cells of another object. It throws hierarchy::Damage if the bytes are malformed.
    std::vector<std::byte> openWeights() const;
    void addOpenWeights(std::span<const std::byte> weights);

    /// Returns the grid points whose weight exceeds `limit`. The last call of `refine(limit)` must have returned false.
    std::vector<hierarchy::GridPoint> pointsAbove(std::uint64_t limit) const;

private:
    friend class ChunkTree;

    /// A table of octree cells of one size inside one parent cell, in Morton order (lowest bit x, then y, then z).
    struct Table {
        int bits = 0;  // bits per coordinate that index the cells of this table
        int shift = 0; // bits per coordinate below the index bits
        std::vector<std::uint64_t> weights;
        std::vector<std::int32_t> finer; // per cell: the table of its child cells, or -1; empty if no cell is divided
    };

    /// The table and the cell that a table of finer cells divides. The root table has no parent.
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

/// The finished octree, which maps each grid point to a chunk.
class ChunkTree {
public:
    /// Creates chunks from runs of octree cells in Morton order. A chunk has at most the weight `limit`. A cell is not
    /// divided if its weight is at most `limit` / 8. Only a chunk of a single grid point can exceed `limit`.
    ChunkTree(const CellCounts& counts, std::uint64_t limit);

    /// Decodes a tree from the bytes that `encoded` returned. The heavy points are not in these bytes. Throws
    /// hierarchy::Damage if the bytes are malformed.
    explicit ChunkTree(std::span<const std::byte> bytes);
    std::vector<std::byte> encoded() const;

    std::uint32_t chunkCount() const { return static_cast<std::uint32_t>(weights_.size()); }

    /// Returns the grid points whose weight exceeds an eighth of the weight limit of a chunk.
    const std::vector<hierarchy::GridPoint>& heavyPoints() const { return heavyPoints_; }

    /// Returns the chunk that contains `point`. The point must have been counted when the tree was built.
    std::uint32_t chunkOf(const hierarchy::GridPoint& point) const;

private:
    struct Table {
        int bits = 0;
        int shift = 0;
        // Chunk of each octree cell. A value from kFiner on is kFiner plus the index of a table of finer cells.
        std::vector<std::uint32_t> chunks;
    };

    static constexpr std::uint32_t kFiner = 0x80000000U;

    void cut(const CellCounts& counts, std::size_t table, std::size_t begin, std::size_t end, std::uint64_t limit);
    void assign(std::size_t table, std::size_t begin, std::size_t end);

    std::vector<Table> tables_;
    std::vector<std::uint64_t> weights_; // weight of each chunk
    std::vector<hierarchy::GridPoint> heavyPoints_;
};

} // namespace gnomon::chunk
