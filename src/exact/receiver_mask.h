// Which cells hold samples, and how far from the light the farthest of them lies (receiver masks: Bittner, Mattausch,
// Silvennoinen and Wimmer 2011): what is nowhere in front of one casts no shadow that is seen.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace gnomon::exact {

/// Cells, both ends included.
struct CellBox {
    int x0 = 0;
    int y0 = 0;
    int x1 = -1;
    int y1 = -1;

    bool empty() const { return x0 > x1 || y0 > y1; }
};

/// A pyramid over the blocks of a map's cells.
class ReceiverMask {
public:
    static constexpr int kBlockBits = 3; // a block has 8 x 8 cells
    static constexpr float kNone = std::numeric_limits<float>::infinity();

    /// A mask over width x height cells in which nothing is; keeps its memory.
    void reset(int width, int height);

    /// The least h of the samples of block (x, y), rounded down; kNone if it has none. Call `finish` once all are set.
    float& lowest(int x, int y) { return levels_[0].lowest[index(0, x, y)]; }

    float lowest(int x, int y) const { return levels_[0].lowest[index(0, x, y)]; }

    int blocksWide() const { return levels_[0].width; }

    int blocksHigh() const { return levels_[0].height; }

    void finish();

    /// Whether no block has a sample.
    bool isEmpty() const { return levels_.back().lowest[0] == kNone; }

    /// Whether a sample in the cells of `box` and those around them may lie below `highest`, the greatest h of
    /// something that covers them.
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
