#include "frame/point_sums.h"

#include <algorithm>

namespace gnomon::frame {

void PointSums::add(const std::vector<std::uint32_t>& first, const std::vector<double>& shares) {
    constexpr std::size_t kCorners = std::size_t{plan::kCellSide} + 1;
    below.assign(kCorners * kCorners, 0);
    for (std::size_t y = 0; y < plan::kCellSide; ++y) {
        float sum = 0;
        for (std::size_t x = 0; x < plan::kCellSide; ++x) {
            const auto points = static_cast<float>(first[y * plan::kCellSide + x + 1] - first[y * plan::kCellSide + x]);
            const std::size_t block = (y >> kBlockBits) * kBlocks + (x >> kBlockBits);
            sum += shares.empty() ? points : points * static_cast<float>(shares[block]);
            below[(y + 1) * (plan::kCellSide + 1) + x + 1] = below[y * (plan::kCellSide + 1) + x + 1] + sum;
        }
    }
}

void AskedCells::add(const exact::ReceiverMask& mask) {
    constexpr std::size_t kCorners = kBlocks + 1;
    below.assign(kCorners * kCorners, 0);
    for (std::size_t y = 0; y < kBlocks; ++y) {
        double sum = 0;
        for (std::size_t x = 0; x < kBlocks; ++x) {
            const bool isAsked = mask.lowest(static_cast<int>(x), static_cast<int>(y)) < exact::ReceiverMask::kNone;
            if (isAsked) sum += kBlockSide * kBlockSide;
            below[(y + 1) * kCorners + x + 1] = below[y * kCorners + x + 1] + sum;
        }
    }
}

double AskedCells::in(const exact::CellBox& box) const {
    if (box.empty()) return 0;
    const auto at = [&](int x, int y) {
        const auto block = [](int cell) { return std::min(static_cast<std::size_t>(cell) >> kBlockBits, kBlocks - 1); };
        const auto between = [&](double low, double high, int cell) {
            return low + (high - low) * (cell - static_cast<int>(block(cell)) * kBlockSide) / kBlockSide;
        };
        const double* corner = &below[block(y) * (kBlocks + 1) + block(x)];
        return between(between(corner[0], corner[1], x), between(corner[kBlocks + 1], corner[kBlocks + 2], x), y);
    };
    return at(box.x1 + 1, box.y1 + 1) + at(box.x0, box.y0) - at(box.x0, box.y1 + 1) - at(box.x1 + 1, box.y0);
}

double PointSums::in(const exact::CellBox& box) const {
    if (box.empty()) return 0;
    const auto at = [&](int x, int y) {
        return double{below[static_cast<std::size_t>(y) * (plan::kCellSide + 1) + static_cast<std::size_t>(x)]};
    };
    return std::max(
        0.0, at(box.x1 + 1, box.y1 + 1) + at(box.x0, box.y0) - at(box.x0, box.y1 + 1) - at(box.x1 + 1, box.y0));
}

} // namespace gnomon::frame
