// Binning: assigns clusters to tiles of the viewport. Tiles with many triangles are split, so that threads share the
// work.
#pragma once

#include "raster/raster.h"

#include <vector>

namespace gnomon::raster {

PixelBox intersection(const PixelBox& a, const PixelBox& b);

/// A cluster for the binning: its bounding box in pixels and its drawing cost.
struct BinItem {
    PixelBox box;
    std::uint32_t cost = 0; // number of triangles
};

/// A tile and its clusters. The clusters are a range of Bins::indices.
struct TileBin {
    PixelBox box;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint64_t cost = 0;
};

struct Bins {
    // disjoint tiles, most expensive first; together they cover the viewport, or all its wanted pixels
    std::vector<TileBin> tiles;
    std::vector<std::uint32_t> indices;

    /// Returns the indices of the items in `tile`, in input order.
    std::span<const std::uint32_t> of(const TileBin& tile) const {
        return std::span(indices).subspan(tile.first, tile.count);
    }
};

/// Assigns items to tiles. Tiles are squares of `side` pixels, clipped to the viewport. A tile with more than 1/32 of
/// the total cost is split into quarters, down to a side of `minSide`. The result depends only on the arguments. The
/// function overwrites `bins` and reuses its memory.
void binItems(std::span<const BinItem> items, const PixelBox& viewport, int side, int minSide, Bins& bins);

/// Min side in pixels of a quarter that is split off because it has no wanted pixel. With smaller tiles, the cost of
/// clusters that overlap several tiles would exceed the gain.
constexpr int kMinUnwantedSide = 64;

/// Assigns items to tiles like binItems, but omits tiles without a wanted pixel. It also splits tiles to find quarters
/// without a wanted pixel.
void binWanted(
    std::span<const BinItem> items,
    const PixelBox& viewport,
    const BoxFilter& isWanted,
    int side,
    int minSide,
    Bins& bins);

} // namespace gnomon::raster
