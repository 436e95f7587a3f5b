#include "raster/farthest_depths.h"

namespace gnomon::raster {

// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): levels are filled as far as the tile reaches
FarthestDepths::FarthestDepths(const std::uint64_t* words, int width, int height)
    : words_(words), width_(width), height_(height) {
    for (std::size_t level = 0; level < kLevels; ++level)
        for (std::size_t y = 0; y <= blockOf(height - 1) >> level; ++y)
            std::fill_n(levels_[level][y].begin(), (blockOf(width - 1) >> level) + 1, 0U);
}

bool FarthestDepths::hides(const PixelBox& box, float nearest) {
    const auto bits = std::bit_cast<std::uint32_t>(nearest);
    for (std::size_t y = blockOf(box.y0); y <= blockOf(box.y1 - 1); ++y)
        for (std::size_t x = blockOf(box.x0); x <= blockOf(box.x1 - 1); ++x) {
            if (levels_[0][y][x] <= bits && isStale(x, y)) update(x, y);
            if (levels_[0][y][x] <= bits && !hidesPart(x, y, box, bits)) return false;
        }
    return true;
}

/// Of the pixels of `box` in one block.
bool FarthestDepths::hidesPart(
    std::size_t blockX, std::size_t blockY, const PixelBox& box, std::uint32_t nearest) const {
    const int x0 = std::max(static_cast<int>(blockX) * kBlockSide, box.x0);
    const int y0 = std::max(static_cast<int>(blockY) * kBlockSide, box.y0);
    const int x1 = std::min(static_cast<int>(blockX + 1) * kBlockSide, box.x1);
    const int y1 = std::min(static_cast<int>(blockY + 1) * kBlockSide, box.y1);
    if (x1 - x0 == kBlockSide && y1 - y0 == kBlockSide) return false;
    for (int y = y0; y < y1; ++y) {
        const std::uint64_t* row = words_ + static_cast<std::size_t>(y) * kTileStride;
        for (int x = x0; x < x1; ++x)
            if (row[x] >> 32U <= nearest) return false;
    }
    return true;
}

void FarthestDepths::update(std::size_t blockX, std::size_t blockY) {
    const int x0 = static_cast<int>(blockX) * kBlockSide;
    const int y0 = static_cast<int>(blockY) * kBlockSide;
    const int x1 = std::min(x0 + kBlockSide, width_);
    const int y1 = std::min(y0 + kBlockSide, height_);
    std::uint64_t least = ~std::uint64_t{0};
    for (int y = y0; y < y1; ++y) {
        const std::uint64_t* row = words_ + static_cast<std::size_t>(y) * kTileStride;
        for (int x = x0; x < x1; ++x)
            least = std::min(least, row[x]);
    }
    levels_[0][blockY][blockX] = static_cast<std::uint32_t>(least >> 32U);
    stale_[blockY] &= ~(1U << blockX);
}

void FarthestDepths::noteDrawn(const PixelBox& box) {
    const std::size_t first = blockOf(box.x0);
    const std::size_t count = blockOf(box.x1 - 1) - first + 1;
    const std::uint32_t mask = ~std::uint32_t{0} >> (kBlocks - count) << first;
    for (std::size_t y = blockOf(box.y0); y <= blockOf(box.y1 - 1); ++y)
        stale_[y] |= mask;
}

bool FarthestDepths::refresh(const PixelBox& box, float farthest) {
    std::uint32_t nearest = 0;
    for (std::size_t y = blockOf(box.y0); y <= blockOf(box.y1 - 1); ++y)
        for (std::size_t x = blockOf(box.x0); x <= blockOf(box.x1 - 1); ++x) {
            if (isStale(x, y)) update(x, y);
            nearest = std::max(nearest, levels_[0][y][x]);
        }
    if (nearest <= std::bit_cast<std::uint32_t>(farthest)) return false;
    updateAbove(box);
    return true;
}

void FarthestDepths::updateAbove(const PixelBox& box) {
    const std::size_t lastX = blockOf(width_ - 1);
    const std::size_t lastY = blockOf(height_ - 1);
    for (std::size_t level = 1; level < kLevels; ++level) {
        const Level& below = levels_[level - 1];
        for (std::size_t y = blockOf(box.y0) >> level; y <= blockOf(box.y1 - 1) >> level; ++y)
            for (std::size_t x = blockOf(box.x0) >> level; x <= blockOf(box.x1 - 1) >> level; ++x) {
                const std::size_t x1 = std::min(2 * x + 1, lastX >> (level - 1));
                const std::size_t y1 = std::min(2 * y + 1, lastY >> (level - 1));
                levels_[level][y][x] =
                    std::min({below[2 * y][2 * x], below[2 * y][x1], below[y1][2 * x], below[y1][x1]});
            }
    }
}

} // namespace gnomon::raster
