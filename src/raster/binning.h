// Binning: assigns clusters to tiles of the viewport. Tiles with many triangles are split, so that threads share the
// work.
#pragma once

#include "raster/raster.h"

#include <vector>

namespace gnomon::raster {

PixelBox intersection(const PixelBox& a, const PixelBox& b);

/// The pixel box and the cost of a cluster.
struct BinItem {
    PixelBox box;
    std::uint32_t cost = 0; // triangles
};

/// A tile with its clusters, as a range of Bins::indices.
struct TileBin {
    PixelBox box;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint64_t cost = 0;
};

struct Bins {
    std::vector<TileBin> tiles; // disjoint; together they cover the viewport or its wanted part; most expensive first
    std::vector<std::uint32_t> indices;

    /// Returns the items of `tile`, in input order.
    std::span<const std::uint32_t> of(const TileBin& tile) const {
        return std::span(indices).subspan(tile.first, tile.count);
    }
};

/// Assigns items to tiles. Tiles are squares of `side` pixels, cut at the viewport. A tile is split, down to
/// `minSide`, while it holds more than 1/32 of the total cost. The result depends only on the arguments. The function
/// overwrites `bins` and reuses its memory.
void binItems(std::span<const BinItem> items, const PixelBox& viewport, int side, int minSide, Bins& bins);

/// Min side of a tile that is split because a part of it is not wanted. Below this side, the cost of shared clusters is
/// larger than the gain.
constexpr int kMinUnwantedSide = 64;

/// Assigns items to tiles and omits tiles without a wanted pixel. It splits tiles to find such parts.
void binWanted(
    std::span<const BinItem> items,
    const PixelBox& viewport,
    const BoxFilter& isWanted,
    int side,
    int minSide,
    Bins& bins);

} // namespace gnomon::raster
