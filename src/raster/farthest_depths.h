// Hierarchical depth of a tile: the pixels, and the farthest depth of each block of pixels.
#pragma once

#include "raster/tile_work.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace gnomon::raster {

/// Returns the nearness of a depth in [0, 1] with reversed depth. Nearness is an integer with the same order as depth;
/// 0 is farthest.
constexpr std::uint32_t reversedNearness(float depth) {
    return std::bit_cast<std::uint32_t>(depth);
}

/// Returns the nearness of a depth in [0, 1] where 0 is nearest, as in shadow maps.
constexpr std::uint32_t plainNearness(float depth) {
    return std::bit_cast<std::uint32_t>(1.0F) - std::bit_cast<std::uint32_t>(depth);
}

/// The words of a visibility buffer.
struct WordDepths {
    using Pixel = std::uint64_t;

    static constexpr std::uint32_t nearness(Pixel word) { return static_cast<std::uint32_t>(word >> 32U); }

    /// Returns true if pixels at `farthest` or nearer hide a triangle of nearness `nearest`. Equal depths do not hide,
    /// because the smaller triangle id wins.
    static constexpr bool isHiddenBy(std::uint32_t farthest, std::uint32_t nearest) { return farthest > nearest; }

    static constexpr Pixel farther(Pixel a, Pixel b) { return std::min(a, b); }
};

/// The depths of a shadow map.
struct MapDepths {
    using Pixel = float;

    static constexpr std::uint32_t nearness(Pixel depth) { return plainNearness(depth); }

    /// Returns true if pixels at `farthest` or nearer hide a triangle. Equal depths hide, because drawing the same
    /// depth changes nothing.
    static constexpr bool isHiddenBy(std::uint32_t farthest, std::uint32_t nearest) { return farthest >= nearest; }

    static constexpr Pixel farther(Pixel a, Pixel b) { return std::max(a, b); }
};

/// The farthest depths of the blocks of a tile, updated when they are needed. All boxes are non-empty pixel ranges
/// relative to the lower left pixel of the tile.
template <class Depths>
class FarthestDepths {
public:
    using Pixel = typename Depths::Pixel;
    static constexpr int kBlockSide = 8;

    /// Starts with a tile of `width` x `height` pixels (rows are kTileStride apart) without drawn pixels.
    FarthestDepths(const Pixel* pixels, int width, int height);

    /// Returns true if a triangle of nearness `nearest` or less cannot change a pixel of `box`. The test is exact per
    /// pixel.
    bool hides(const PixelBox& box, std::uint32_t nearest);

    /// Marks the blocks of `box` as changed by drawing.
    void noteDrawn(const PixelBox& box);

private:
    static constexpr std::size_t kBlocks = kTileSide / kBlockSide; // blocks along a side of the largest tile

    static constexpr std::size_t blockOf(int pixel) { return static_cast<std::size_t>(pixel) / kBlockSide; }

    bool hidesIn(std::size_t blockX, std::size_t blockY, const PixelBox& box, std::uint32_t nearest);

    const Pixel* pixels_;
    int width_;
    int height_;
    std::array<std::array<std::uint32_t, kBlocks>, kBlocks> farthest_; // valid within the tile
    /// One bit per block, row by row: drawing may have made the block's farthest depth nearer.
    std::array<std::uint32_t, kBlocks> stale_{};
};

extern template class FarthestDepths<WordDepths>;
extern template class FarthestDepths<MapDepths>;

} // namespace gnomon::raster
