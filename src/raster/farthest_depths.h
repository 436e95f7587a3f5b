// A hierarchical depth buffer of one tile: the farthest depth of each block of pixels.
#pragma once

#include "raster/tile_work.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace gnomon::raster {

/// Converts a reversed depth in [0, 1] (1 is nearest) to a nearness, an integer that is larger for nearer depths.
/// Nearness 0 is the farthest depth.
constexpr std::uint32_t reversedNearness(float depth) {
    return std::bit_cast<std::uint32_t>(depth);
}

/// Converts a shadow map depth in [0, 1] (0 is nearest) to a nearness, an integer that is larger for nearer depths.
constexpr std::uint32_t plainNearness(float depth) {
    return std::bit_cast<std::uint32_t>(1.0F) - std::bit_cast<std::uint32_t>(depth);
}

/// Pixel format of a visibility buffer: each pixel is a word that contains a depth and a triangle id.
struct WordDepths {
    using Pixel = std::uint64_t;

    static constexpr std::uint32_t nearness(Pixel word) { return static_cast<std::uint32_t>(word >> 32U); }

    /// Returns true if pixels hide a triangle. All pixels have at least the nearness `farthest`, and the triangle has
    /// at most the nearness `nearest`. If both are equal, the triangle may be visible, because of two equal depths the
    /// smaller triangle id is visible.
    static constexpr bool isHiddenBy(std::uint32_t farthest, std::uint32_t nearest) { return farthest > nearest; }

    static constexpr Pixel farther(Pixel a, Pixel b) { return std::min(a, b); }
};

/// Pixel format of a shadow map: each pixel is a depth.
struct MapDepths {
    using Pixel = float;

    static constexpr std::uint32_t nearness(Pixel depth) { return plainNearness(depth); }

    /// Returns true if pixels hide a triangle. All pixels have at least the nearness `farthest`, and the triangle has
    /// at most the nearness `nearest`. If both are equal, the triangle is hidden, because drawing the same depth again
    /// changes nothing.
    static constexpr bool isHiddenBy(std::uint32_t farthest, std::uint32_t nearest) { return farthest >= nearest; }

    static constexpr Pixel farther(Pixel a, Pixel b) { return std::max(a, b); }
};

/// The farthest depth of each block of pixels of a tile. A block is updated only when an occlusion test reads it. All
/// pixel boxes are non-empty and relative to the lower left pixel of the tile.
template <class Depths>
class FarthestDepths {
public:
    using Pixel = typename Depths::Pixel;
    static constexpr int kBlockSide = 8;

    /// Starts with an empty tile of `width` x `height` pixels, before any triangle is drawn. Rows are kTileStride
    /// pixels apart in memory.
    FarthestDepths(const Pixel* pixels, int width, int height);

    /// Returns true if the drawn pixels of `box` hide each triangle whose nearness (larger is nearer) is at most
    /// `nearest`. The test is exact per pixel.
    bool hides(const PixelBox& box, std::uint32_t nearest);

    /// Marks the blocks that intersect `box` as outdated, because a triangle was drawn there.
    void noteDrawn(const PixelBox& box);

private:
    static constexpr std::size_t kBlocks = kTileSide / kBlockSide; // max number of blocks along a side of a tile

    static constexpr std::size_t blockOf(int pixel) { return static_cast<std::size_t>(pixel) / kBlockSide; }

    bool hidesIn(std::size_t blockX, std::size_t blockY, const PixelBox& box, std::uint32_t nearest);

    const Pixel* pixels_;
    int width_;
    int height_;
    // Nearness of the farthest pixel of each block. Only blocks inside the tile are valid.
    std::array<std::array<std::uint32_t, kBlocks>, kBlocks> farthest_;
    /// One bit per block and one word per row of blocks. A set bit means that the block's farthest depth is outdated,
    /// because drawing may have brought it nearer.
    std::array<std::uint32_t, kBlocks> stale_{};
};

extern template class FarthestDepths<WordDepths>;
extern template class FarthestDepths<MapDepths>;

} // namespace gnomon::raster
