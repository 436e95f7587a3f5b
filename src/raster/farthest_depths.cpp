#include "raster/farthest_depths.h"

namespace gnomon::raster {

// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): the body fills the blocks of the tile
template <class Depths>
FarthestDepths<Depths>::FarthestDepths(const Pixel* pixels, int width, int height)
    : pixels_(pixels), width_(width), height_(height) {
    for (std::size_t y = 0; y <= blockOf(height - 1); ++y)
        std::fill_n(farthest_[y].begin(), blockOf(width - 1) + 1, 0U);
}

template <class Depths>
bool FarthestDepths<Depths>::hides(const PixelBox& box, std::uint32_t nearest) {
    for (std::size_t y = blockOf(box.y0); y <= blockOf(box.y1 - 1); ++y)
        for (std::size_t x = blockOf(box.x0); x <= blockOf(box.x1 - 1); ++x)
            if (!Depths::isHiddenBy(farthest_[y][x], nearest) && !hidesIn(x, y, box, nearest)) return false;
    return true;
}

/// Returns true if all pixels of `box` within one block hide a triangle of nearness `nearest`. The function is called
/// if the stored farthest depth of the block does not hide the triangle. The first pixels usually show that a triangle
/// is visible. The function therefore updates the farthest depth only if all pixels hide the triangle.
template <class Depths>
bool FarthestDepths<Depths>::hidesIn(
    std::size_t blockX, std::size_t blockY, const PixelBox& box, std::uint32_t nearest) {
    const int blockX0 = static_cast<int>(blockX) * kBlockSide;
    const int blockY0 = static_cast<int>(blockY) * kBlockSide;
    const PixelBox block = {
        blockX0, blockY0, std::min(blockX0 + kBlockSide, width_), std::min(blockY0 + kBlockSide, height_)};
    const PixelBox part = {
        std::max(block.x0, box.x0), std::max(block.y0, box.y0), std::min(block.x1, box.x1), std::min(block.y1, box.y1)};
    const bool isStale = (stale_[blockY] >> blockX & 1U) != 0;
    if (part == block && !isStale) return false;
    Pixel farthest = pixels_[static_cast<std::size_t>(part.y0) * kTileStride + static_cast<std::size_t>(part.x0)];
    for (int y = part.y0; y < part.y1; ++y) {
        const Pixel* row = pixels_ + static_cast<std::size_t>(y) * kTileStride;
        for (int x = part.x0; x < part.x1; ++x)
            farthest = Depths::farther(farthest, row[x]);
        if (!Depths::isHiddenBy(Depths::nearness(farthest), nearest)) return false;
    }
    if (part == block) {
        farthest_[blockY][blockX] = Depths::nearness(farthest);
        stale_[blockY] &= ~(1U << blockX);
    }
    return true;
}

template <class Depths>
void FarthestDepths<Depths>::noteDrawn(const PixelBox& box) {
    const std::size_t first = blockOf(box.x0);
    const std::size_t count = blockOf(box.x1 - 1) - first + 1;
    const std::uint32_t mask = ~std::uint32_t{0} >> (kBlocks - count) << first;
    for (std::size_t y = blockOf(box.y0); y <= blockOf(box.y1 - 1); ++y)
        stale_[y] |= mask;
}

template class FarthestDepths<WordDepths>;
template class FarthestDepths<MapDepths>;

} // namespace gnomon::raster
