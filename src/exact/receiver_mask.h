// The receiver mask: the smallest height towards the light of the samples in each block of 8 x 8 grid cells (Bittner,
// Mattausch, Silvennoinen and Wimmer 2011). Casters behind all samples of their blocks cast no visible shadow.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace gnomon::exact {

/// A rectangle of grid cells, both ends included.
struct CellBox {
    int x0 = 0;
    int y0 = 0;
    int x1 = -1;
    int y1 = -1;

    bool empty() const { return x0 > x1 || y0 > y1; }
};

/// The receiver mask of one map, as a pyramid of min values over blocks of cells.
class ReceiverMask {
public:
    static constexpr int kBlockBits = 3; // a block has 8 x 8 cells
    static constexpr float kNone = std::numeric_limits<float>::infinity();

    /// Clears the mask for width x height cells. Reuses the memory.
    void reset(int width, int height);

    /// The smallest height h of the samples in block (x, y), rounded down, or kNone if the block has no samples. After
    /// the caller has set all blocks, it must call `finish`.
    float& lowest(int x, int y) { return levels_[0].lowest[index(0, x, y)]; }

    float lowest(int x, int y) const { return levels_[0].lowest[index(0, x, y)]; }

    int blocksWide() const { return levels_[0].width; }

    int blocksHigh() const { return levels_[0].height; }

    void finish();

    /// Returns true if no block of cells contains a sample.
    bool isEmpty() const { return levels_.back().lowest[0] == kNone; }

    /// Returns true if a caster may shadow a sample. The caster covers the cells of `box`, and its largest height is
    /// `highest`. The test reads whole blocks, so it may also consider cells beside the box.
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
