// Which clusters touch which tile: tiles of a viewport, split where many triangles meet so that threads share the work.
#pragma once

#include "raster/raster.h"

#include <vector>

namespace gnomon::raster {

PixelBox intersection(const PixelBox& a, const PixelBox& b);

/// What binning needs to know of a cluster.
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
    std::vector<TileBin> tiles; // disjoint, together the viewport or what of it is wanted; dearest first
    std::vector<std::uint32_t> indices;

    /// The items of a tile, in their order.
    std::span<const std::uint32_t> of(const TileBin& tile) const {
        return std::span(indices).subspan(tile.first, tile.count);
    }
};

/// Tiles are squares of `side` pixels (cut off by the viewport), split down to `leastSide` while one holds more than
/// 1/32 of all cost. Depends on nothing but the arguments. `bins` is overwritten and keeps its memory.
void binItems(std::span<const BinItem> items, const PixelBox& viewport, int side, int leastSide, Bins& bins);

/// The sides of a tile that is still split where a part of it is not wanted: below, what is shared costs more.
constexpr int kLeastUnwantedSide = 64;

/// The same without the tiles that hold nothing `isWanted`, which are split to find them.
void binWanted(
    std::span<const BinItem> items,
    const PixelBox& viewport,
    const BoxFilter& isWanted,
    int side,
    int leastSide,
    Bins& bins);

} // namespace gnomon::raster
