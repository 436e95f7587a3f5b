// The hierarchical depth of a tile of a visibility buffer: for blocks of pixels, of several sizes, a depth that none of
// them is behind.
#pragma once

#include "raster/tile_work.h"

#include <algorithm>
#include <array>
#include <bit>

namespace gnomon::raster {

/// Farthest depths of blocks of a tile, brought up to date where they are asked for. Depths are reversed, so the
/// farthest is the least; they are held as the bits of floats, which order as these do from 0 on. All boxes are of
/// pixels of the tile, from its lowest left one, and not empty.
class FarthestDepths {
public:
    static constexpr int kBlockBits = 3;
    static constexpr int kBlockSide = 1 << kBlockBits;
    static constexpr std::size_t kBlocks = kTileSide / kBlockSide; // along a side of the largest tile
    static constexpr std::size_t kLevels = 6;                      // blocks of 8, 16, ... 256 pixels

    /// Of a tile of `width` x `height` pixels whose `words` (rows kTileStride apart) are all 0.
    FarthestDepths(const std::uint64_t* words, int width, int height);

    /// Whether every pixel of `box` holds something nearer than `nearest`, to the pixel.
    bool hides(const PixelBox& box, float nearest);

    /// Says that words in `box` have grown.
    void noteDrawn(const PixelBox& box);

    /// Brings the blocks of all sizes that touch `box` up to date, and answers whether any pixel there holds something
    /// nearer than `farthest`: if not, nothing that far or nearer is hidden there.
    bool refresh(const PixelBox& box, float farthest);

    /// The farthest depths: that of block (x, y) of blocks of 8 << level pixels is [(level * kBlocks + y) * kBlocks +
    /// x].
    const std::uint32_t* levels() const { return levels_[0][0].data(); }

private:
    using Level = std::array<std::array<std::uint32_t, kBlocks>, kBlocks>;

    static constexpr std::size_t blockOf(int pixel) { return static_cast<std::size_t>(pixel) >> kBlockBits; }

    bool isStale(std::size_t x, std::size_t y) const { return (stale_[y] >> x & 1U) != 0; }

    bool hidesPart(std::size_t blockX, std::size_t blockY, const PixelBox& box, std::uint32_t nearest) const;
    void update(std::size_t blockX, std::size_t blockY);
    void updateAbove(const PixelBox& box);

    const std::uint64_t* words_;
    int width_;
    int height_;
    std::array<Level, kLevels> levels_;          // NOLINT: filled as far as the tile reaches
    std::array<std::uint32_t, kBlocks> stale_{}; // of the smallest blocks, rows of bits: more was drawn since
};

} // namespace gnomon::raster
