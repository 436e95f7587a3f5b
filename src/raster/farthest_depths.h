// The hierarchical depth of a tile of a visibility buffer: its pixels, and for each block of them a depth that none is
// behind.
#pragma once

#include "raster/tile_work.h"

#include <array>

namespace gnomon::raster {

/// Farthest depths of blocks of a tile, brought up to date where they are asked for. Depths are reversed, so the
/// farthest is the least; they are held as the bits of floats, which order as these do from 0 on. All boxes are of
/// pixels of the tile, from its lowest left one, and not empty.
class FarthestDepths {
public:
    static constexpr int kBlockSide = 8;

    /// Of a tile of `width` x `height` pixels whose `words` (rows kTileStride apart) are all 0.
    FarthestDepths(const std::uint64_t* words, int width, int height);

    /// Whether every pixel of `box` holds something nearer than `nearest`, to the pixel.
    bool hides(const PixelBox& box, float nearest);

    /// Says that words in `box` have grown.
    void noteDrawn(const PixelBox& box);

private:
    static constexpr std::size_t kBlocks = kTileSide / kBlockSide; // along a side of the largest tile

    static constexpr std::size_t blockOf(int pixel) { return static_cast<std::size_t>(pixel) / kBlockSide; }

    bool hidesIn(std::size_t blockX, std::size_t blockY, const PixelBox& box, std::uint32_t nearest);

    const std::uint64_t* words_;
    int width_;
    int height_;
    std::array<std::array<std::uint32_t, kBlocks>, kBlocks> farthest_; // filled as far as the tile reaches
    std::array<std::uint32_t, kBlocks> stale_{}; // rows of bits: more was drawn since, so that it may be nearer
};

} // namespace gnomon::raster
