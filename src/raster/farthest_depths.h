// Hierarchical depth of a tile: the farthest depth of each block of pixels, above the pixels themselves.
#pragma once

#include "raster/tile_work.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace gnomon::raster {

/// Converts a reversed depth in [0, 1] (1 is nearest) to a nearness: an integer with the same order. Nearness 0 is the
/// farthest.
constexpr std::uint32_t reversedNearness(float depth) {
    return std::bit_cast<std::uint32_t>(depth);
}

/// Converts a depth in [0, 1] where 0 is nearest, as in shadow maps, to a nearness.
constexpr std::uint32_t plainNearness(float depth) {
    return std::bit_cast<std::uint32_t>(1.0F) - std::bit_cast<std::uint32_t>(depth);
}

/// The pixels of a visibility buffer: words that contain depth and triangle id.
struct WordDepths {
    using Pixel = std::uint64_t;

    static constexpr std::uint32_t nearness(Pixel word) { return static_cast<std::uint32_t>(word >> 32U); }

    /// Returns true if pixels whose nearness is at least `farthest` hide a triangle of nearness `nearest`. A pixel of
    /// equal nearness does not hide the triangle, because the smaller triangle id is visible.
    static constexpr bool isHiddenBy(std::uint32_t farthest, std::uint32_t nearest) { return farthest > nearest; }

    static constexpr Pixel farther(Pixel a, Pixel b) { return std::min(a, b); }
};

/// The pixels of a shadow map: depths.
struct MapDepths {
    using Pixel = float;

    static constexpr std::uint32_t nearness(Pixel depth) { return plainNearness(depth); }

    /// Returns true if pixels whose nearness is at least `farthest` hide a triangle of nearness `nearest`. A pixel of
    /// equal nearness hides the triangle, because drawing the same depth changes nothing.
    static constexpr bool isHiddenBy(std::uint32_t farthest, std::uint32_t nearest) { return farthest >= nearest; }

    static constexpr Pixel farther(Pixel a, Pixel b) { return std::max(a, b); }
};

/// The farthest depths of the blocks of a tile. They are updated only when a test needs them. All boxes are non-empty
/// pixel ranges relative to the lower left pixel of the tile.
template <class Depths>
class FarthestDepths {
public:
    using Pixel = typename Depths::Pixel;
    static constexpr int kBlockSide = 8;

    /// Starts with the empty pixels of a tile of `width` x `height` pixels. Rows are kTileStride pixels apart.
    FarthestDepths(const Pixel* pixels, int width, int height);

    /// Returns true if a triangle whose nearness is at most `nearest` cannot change a pixel of `box`. The test is exact
    /// per pixel.
    bool hides(const PixelBox& box, std::uint32_t nearest);

    /// Marks the blocks that intersect `box` as changed by drawing.
    void noteDrawn(const PixelBox& box);

private:
    static constexpr std::size_t kBlocks = kTileSide / kBlockSide; // max number of blocks along a side of a tile

    static constexpr std::size_t blockOf(int pixel) { return static_cast<std::size_t>(pixel) / kBlockSide; }

    bool hidesIn(std::size_t blockX, std::size_t blockY, const PixelBox& box, std::uint32_t nearest);

    const Pixel* pixels_;
    int width_;
    int height_;
    // nearness of the farthest pixel of each block; only blocks of the tile are valid
    std::array<std::array<std::uint32_t, kBlocks>, kBlocks> farthest_;
    /// One bit per block, one word per row of blocks. The bit is set if drawing may have brought the block's farthest
    /// depth nearer.
    std::array<std::uint32_t, kBlocks> stale_{};
};

extern template class FarthestDepths<WordDepths>;
extern template class FarthestDepths<MapDepths>;

} // namespace gnomon::raster
