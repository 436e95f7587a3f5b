#include "raster/uneven/column_runs.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>

namespace gnomon::raster {

void ColumnRuns::reset(std::span<const ColumnRun> runs, int firstColumn, float guardPixels) {
    bands_.clear();
    int first = firstColumn;
    float steepest = 0;
    for (const ColumnRun& run : runs) {
        GNOMON_CHECK_OP(run.end, >, first);
        GNOMON_CHECK(run.scale > 0);
        bands_.push_back({first, run.end, run.scale, run.offset});
        steepest = std::max(steepest, run.scale);
        first = run.end;
    }
    if (bands_.empty()) return;
    // A pixel more than there is, for what is rounded.
    const ColumnBand& left = bands_.front();
    const ColumnBand& right = bands_.back();
    lowest_ = (static_cast<float>(left.first) - 1 - left.offset) / left.scale;
    highest_ = (static_cast<float>(right.end) + 1 - right.offset) / right.scale;
    const float least = std::exp2(std::ceil(std::log2(std::max(std::abs(lowest_), std::abs(highest_)))));
    guard_ = std::max(least, std::exp2(std::floor(std::log2(guardPixels / steepest))));
    for (const ColumnBand& band : bands_)
        GNOMON_CHECK_OP(guard_ * band.scale + std::abs(band.offset), <=, 0x1p17F);
}

std::array<int, 2> ColumnRuns::columnsBetween(float low, float high) const {
    const auto found = [this](float xOverW, int beyond) {
        // In the last run that begins left of it; each function goes on where the one before ends.
        const auto after = std::partition_point(bands_.begin() + 1, bands_.end(), [&](const ColumnBand& band) {
            return xOverW * band.scale + band.offset >= static_cast<float>(band.first);
        });
        const ColumnBand& band = *(after - 1);
        const float column = std::floor(xOverW * band.scale + band.offset) + static_cast<float>(beyond);
        return static_cast<int>(
            std::clamp(column, static_cast<float>(bands_.front().first), static_cast<float>(bands_.back().end)));
    };
    return {found(low, -1), found(high, 2)};
}

} // namespace gnomon::raster
