#include "exact/receiver_mask.h"

#include <algorithm>

namespace gnomon::exact {

void ReceiverMask::reset(int width, int height) {
    const auto blocks = [](int cells) { return (cells + (1 << kBlockBits) - 1) >> kBlockBits; };
    int w = std::max(blocks(width), 1);
    int h = std::max(blocks(height), 1);
    for (std::size_t level = 0;; ++level) {
        if (level == levels_.size()) levels_.emplace_back();
        levels_[level].width = w;
        levels_[level].height = h;
        levels_[level].lowest.assign(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), kNone);
        if (w == 1 && h == 1) {
            levels_.resize(level + 1);
            return;
        }
        w = (w + 1) / 2;
        h = (h + 1) / 2;
    }
}

void ReceiverMask::finish() {
    for (std::size_t l = 1; l < levels_.size(); ++l)
        for (int y = 0; y < levels_[l - 1].height; ++y)
            for (int x = 0; x < levels_[l - 1].width; ++x) {
                float& lowest = levels_[l].lowest[index(l, x / 2, y / 2)];
                lowest = std::min(lowest, levels_[l - 1].lowest[index(l - 1, x, y)]);
            }
}

bool ReceiverMask::mayShadow(const CellBox& box, float highest) const {
    std::size_t level = 0;
    int shift = kBlockBits;
    while ((box.x1 >> shift) - (box.x0 >> shift) > 3 || (box.y1 >> shift) - (box.y0 >> shift) > 3) {
        ++shift;
        ++level;
    }
    for (int y = box.y0 >> shift; y <= box.y1 >> shift; ++y)
        for (int x = box.x0 >> shift; x <= box.x1 >> shift; ++x)
            if (levels_[level].lowest[index(level, x, y)] < highest) return true;
    return false;
}

} // namespace gnomon::exact
