#include "raster/binning.h"

#include <algorithm>
#include <array>

namespace gnomon::raster {
namespace {

/// A tile is split if its cost exceeds the total cost of the pass divided by this number.
constexpr std::uint64_t kMaxTilesWorth = 32;

/// Returns the range of tile columns and rows that `box` intersects.
PixelBox touchedTiles(const PixelBox& box, const PixelBox& viewport, int side) {
    return {
        (box.x0 - viewport.x0) / side,
        (box.y0 - viewport.y0) / side,
        (box.x1 - 1 - viewport.x0) / side + 1,
        (box.y1 - 1 - viewport.y0) / side + 1};
}

template <class Visit>
void forEachTouched(
    std::span<const BinItem> items, const PixelBox& viewport, int side, std::size_t columns, const Visit& visit) {
    for (std::uint32_t i = 0; i < items.size(); ++i) {
        const PixelBox box = intersection(items[i].box, viewport);
        if (box.empty()) continue;
        const PixelBox touched = touchedTiles(box, viewport, side);
        for (int y = touched.y0; y < touched.y1; ++y)
            for (int x = touched.x0; x < touched.x1; ++x)
                visit(i, static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x));
    }
}

void fillTiles(std::span<const BinItem> items, const PixelBox& viewport, int side, Bins& bins) {
    const int columns = (viewport.width() + side - 1) / side;
    const int rows = (viewport.height() + side - 1) / side;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const int x0 = viewport.x0 + x * side;
            const int y0 = viewport.y0 + y * side;
            bins.tiles.push_back({intersection({x0, y0, x0 + side, y0 + side}, viewport)});
        }
    const auto columnCount = static_cast<std::size_t>(columns);
    forEachTouched(items, viewport, side, columnCount, [&](std::uint32_t i, std::size_t tile) {
        ++bins.tiles[tile].count;
        bins.tiles[tile].cost += items[i].cost;
    });
    std::uint32_t total = 0;
    for (TileBin& tile : bins.tiles) {
        tile.first = total;
        total += tile.count;
        tile.count = 0;
    }
    bins.indices.resize(total);
    forEachTouched(items, viewport, side, columnCount, [&](std::uint32_t i, std::size_t tile) {
        bins.indices[bins.tiles[tile].first + bins.tiles[tile].count++] = i;
    });
}

TileBin quarterOf(std::span<const BinItem> items, const TileBin& tile, const PixelBox& box, Bins& bins) {
    TileBin quarter{box, static_cast<std::uint32_t>(bins.indices.size())};
    for (std::uint32_t k = 0; k < tile.count; ++k) {
        const std::uint32_t i = bins.indices[tile.first + k];
        if (intersection(items[i].box, box).empty()) continue;
        bins.indices.push_back(i);
        ++quarter.count;
        quarter.cost += items[i].cost;
    }
    return quarter;
}

/// Returns the four quarters of `box`. If the box is narrow, some quarters can be empty.
std::array<PixelBox, 4> quarters(const PixelBox& box) {
    const int middleX = box.x0 + (box.width() + 1) / 2;
    const int middleY = box.y0 + (box.height() + 1) / 2;
    return {
        PixelBox{box.x0, box.y0, middleX, middleY},
        PixelBox{middleX, box.y0, box.x1, middleY},
        PixelBox{box.x0, middleY, middleX, box.y1},
        PixelBox{middleX, middleY, box.x1, box.y1}};
}

/// Replaces tile `t` of `bins` by its quarters.
void splitTile(std::span<const BinItem> items, std::size_t t, Bins& bins) {
    const TileBin tile = bins.tiles[t];
    bool isFirst = true;
    for (const PixelBox& box : quarters(tile.box)) {
        if (box.empty()) continue;
        const TileBin quarter = quarterOf(items, tile, box, bins);
        if (isFirst)
            bins.tiles[t] = quarter;
        else
            bins.tiles.push_back(quarter);
        isFirst = false;
    }
}

bool hasMinSide(const PixelBox& box, int side) {
    return std::min(box.width(), box.height()) >= side;
}

/// Removes tiles that contain no pixel that the caller needs. Splits tiles if the caller needs no pixel of a quarter.
void dropUnwanted(std::span<const BinItem> items, const BoxFilter& isWanted, Bins& bins) {
    const auto isUnwanted = [&](const PixelBox& box) { return !box.empty() && !isWanted(box); };
    for (std::size_t t = 0; t < bins.tiles.size();) {
        const PixelBox box = bins.tiles[t].box;
        if (isUnwanted(box)) {
            bins.tiles[t] = bins.tiles.back();
            bins.tiles.pop_back();
            continue;
        }
        const auto parts = quarters(box);
        if (hasMinSide(box, 2 * kMinUnwantedSide) && std::any_of(parts.begin(), parts.end(), isUnwanted))
            splitTile(items, t, bins);
        else
            ++t;
    }
}

/// Splits tiles with more than 1/32 of the total cost, and sorts all tiles by decreasing cost.
void shareOut(std::span<const BinItem> items, int minSide, Bins& bins) {
    std::uint64_t total = 0;
    for (const TileBin& tile : bins.tiles)
        total += tile.cost;
    for (std::size_t t = 0; t < bins.tiles.size();) {
        const TileBin& tile = bins.tiles[t];
        if (hasMinSide(tile.box, 2 * minSide) && tile.cost * kMaxTilesWorth > total)
            splitTile(items, t, bins);
        else
            ++t;
    }
    std::stable_sort(
        bins.tiles.begin(), bins.tiles.end(), [](const TileBin& a, const TileBin& b) { return a.cost > b.cost; });
}

} // namespace

PixelBox intersection(const PixelBox& a, const PixelBox& b) {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

void binItems(std::span<const BinItem> items, const PixelBox& viewport, int side, int minSide, Bins& bins) {
    binWanted(items, viewport, {}, side, minSide, bins);
}

void binWanted(
    std::span<const BinItem> items,
    const PixelBox& viewport,
    const BoxFilter& isWanted,
    int side,
    int minSide,
    Bins& bins) {
    bins.tiles.clear();
    bins.indices.clear();
    if (viewport.empty()) return;
    fillTiles(items, viewport, side, bins);
    if (isWanted) dropUnwanted(items, isWanted, bins);
    shareOut(items, minSide, bins);
    // The last splits can create small tiles without a pixel that the caller needs. dropUnwanted does not test tiles
    // of this size.
    if (isWanted) std::erase_if(bins.tiles, [&](const TileBin& tile) { return !isWanted(tile.box); });
}

} // namespace gnomon::raster
