// The receiver mask: which blocks of cells contain samples, and the depth of the farthest sample from the light
// (receiver masks: Bittner, Mattausch, Silvennoinen and Wimmer 2011). Casters behind all samples cast no visible
// shadow.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace gnomon::exact {

/// A range of cells, both ends included.
struct CellBox {
    int x0 = 0;
    int y0 = 0;
    int x1 = -1;
    int y1 = -1;

    bool empty() const { return x0 > x1 || y0 > y1; }
};

/// The receiver mask of one map, as a pyramid of levels over the blocks of the map's cells.
class ReceiverMask {
public:
    static constexpr int kBlockBits = 3; // a block has 8 x 8 cells
    static constexpr float kNone = std::numeric_limits<float>::infinity();

    /// Resets the mask to no samples, for width x height cells. Reuses the memory.
    void reset(int width, int height);

    /// Returns the smallest h of the samples in block (x, y), rounded down, or kNone if the block has no samples. After
    /// the caller has set all blocks, it must call `finish`.
    float& lowest(int x, int y) { return levels_[0].lowest[index(0, x, y)]; }

    float lowest(int x, int y) const { return levels_[0].lowest[index(0, x, y)]; }

    int blocksWide() const { return levels_[0].width; }

    int blocksHigh() const { return levels_[0].height; }

    void finish();

    /// Returns true if no block contains a sample.
    bool isEmpty() const { return levels_.back().lowest[0] == kNone; }

    /// Returns true if a caster may shadow a sample. The caster covers the cells of `box`, and `highest` is its largest
    /// h. The test also includes the other cells of the covered blocks.
    bool mayShadow(const CellBox& box, float highest) const;

private:
    struct Level {
        int width = 0;
        int height = 0;
        std::vector<float> lowest;
    };

    std::size_t index(std::size_t level, int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(levels_[level].width) +
               static_cast<std::size_t>(x);
    }

    std::vector<Level> levels_;
};

} // namespace gnomon::exact
