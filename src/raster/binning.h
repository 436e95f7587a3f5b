// Binning: finds the clusters that overlap each tile of the viewport. Tiles with many triangles are split, so that
// threads share the work.
#pragma once

#include "raster/raster.h"

#include <vector>

namespace gnomon::raster {

PixelBox intersection(const PixelBox& a, const PixelBox& b);

/// The bounding box in pixels and the drawing cost of a cluster, for the binning.
struct BinItem {
    PixelBox box;
    std::uint32_t cost = 0; // number of triangles
};

/// A tile and the clusters that overlap it. The indices of these clusters are a range of Bins::indices.
struct TileBin {
    PixelBox box;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint64_t cost = 0;
};

struct Bins {
    // Disjoint tiles, the most expensive first. Together they cover the viewport, or all pixels that the caller needs.
    std::vector<TileBin> tiles;
    std::vector<std::uint32_t> indices;

    /// Returns the indices of the clusters that overlap `tile`, in input order.
    std::span<const std::uint32_t> of(const TileBin& tile) const {
        return std::span(indices).subspan(tile.first, tile.count);
    }
};

/// Finds the clusters that overlap each tile. Tiles are squares of `side` pixels, clipped to the viewport. A tile with
/// more than 1/32 of the total cost is split into quarters, down to a side of `minSide`. The result depends only on the
/// arguments. The function overwrites `bins` and reuses its memory.
void binItems(std::span<const BinItem> items, const PixelBox& viewport, int side, int minSide, Bins& bins);

/// Min side in pixels of a quarter that is split off a tile because the caller needs none of its pixels. With smaller
/// tiles, clusters that overlap several tiles would cost more than the split saves.
constexpr int kMinUnwantedSide = 64;

/// Finds the clusters that overlap each tile like binItems, but omits tiles without a pixel that the caller needs. The
/// function also splits tiles to omit such quarters.
void binWanted(
    std::span<const BinItem> items,
    const PixelBox& viewport,
    const BoxFilter& isWanted,
    int side,
    int minSide,
    Bins& bins);

} // namespace gnomon::raster
