// The hierarchical depth of a tile: its pixels, and for each block of them a depth that none is behind.
#pragma once

#include "raster/tile_work.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace gnomon::raster {

/// How near a depth from 0 to 1 is: orders as they do where depths are reversed, and is 0 for what is farthest.
constexpr std::uint32_t reversedNearness(float depth) {
    return std::bit_cast<std::uint32_t>(depth);
}

/// The same where 0 is nearest, as in shadow maps.
constexpr std::uint32_t plainNearness(float depth) {
    return std::bit_cast<std::uint32_t>(1.0F) - std::bit_cast<std::uint32_t>(depth);
}

/// Words of a visibility buffer.
struct WordDepths {
    using Pixel = std::uint64_t;

    static constexpr std::uint32_t nearness(Pixel word) { return static_cast<std::uint32_t>(word >> 32U); }

    /// What hides all that is `nearest` or less is nearer than that: a tie goes to the lesser name.
    static constexpr bool isHiddenBy(std::uint32_t farthest, std::uint32_t nearest) { return farthest > nearest; }

    static constexpr Pixel farther(Pixel a, Pixel b) { return std::min(a, b); }
};

/// Depths of a shadow map.
struct MapDepths {
    using Pixel = float;

    static constexpr std::uint32_t nearness(Pixel depth) { return plainNearness(depth); }

    /// A depth that is there already changes nothing.
    static constexpr bool isHiddenBy(std::uint32_t farthest, std::uint32_t nearest) { return farthest >= nearest; }

    static constexpr Pixel farther(Pixel a, Pixel b) { return std::max(a, b); }
};

/// Farthest depths of blocks of a tile, brought up to date where they are asked for. All boxes are of pixels of the
/// tile, from its lowest left one, and not empty.
template <class Depths>
class FarthestDepths {
public:
    using Pixel = typename Depths::Pixel;
    static constexpr int kBlockSide = 8;

    /// Of a tile of `width` x `height` pixels (rows kTileStride apart) in which nothing is drawn yet.
    FarthestDepths(const Pixel* pixels, int width, int height);

    /// Whether what is drawn at `nearest` or less near would change no pixel of `box`, to the pixel.
    bool hides(const PixelBox& box, std::uint32_t nearest);

    /// Says that something was drawn in `box`.
    void noteDrawn(const PixelBox& box);

private:
    static constexpr std::size_t kBlocks = kTileSide / kBlockSide; // along a side of the largest tile

    static constexpr std::size_t blockOf(int pixel) { return static_cast<std::size_t>(pixel) / kBlockSide; }

    bool hidesIn(std::size_t blockX, std::size_t blockY, const PixelBox& box, std::uint32_t nearest);

    const Pixel* pixels_;
    int width_;
    int height_;
    std::array<std::array<std::uint32_t, kBlocks>, kBlocks> farthest_; // filled as far as the tile reaches
    std::array<std::uint32_t, kBlocks> stale_{}; // rows of bits: more was drawn since, so that it may be nearer
};

extern template class FarthestDepths<WordDepths>;
extern template class FarthestDepths<MapDepths>;

} // namespace gnomon::raster
