#include "raster/uneven/row_bands.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::raster {
namespace {

float powerOfTwoFrom(float value) {
    return std::exp2(std::ceil(std::log2(value)));
}

/// Returns the scale from y / w to units of a band. With this scale, adjacent rows stay more than one bucket apart
/// after rounding. `narrowest` is the narrowest gap between rows.
float scaleFor(int bucketBits, float narrowest) {
    return powerOfTwoFrom(static_cast<float>((1 << bucketBits) + 2) / narrowest);
}

} // namespace

void RowBands::reset(std::span<const float> positions, int firstRow) {
    GNOMON_CHECK(!positions.empty());
    positions_.assign(positions.begin(), positions.end());
    bands_.clear();
    firstRow_ = firstRow;
    const float low = positions_.front();
    const float high = positions_.back();
    guard_ = powerOfTwoFrom(std::max({std::abs(low), std::abs(high), std::numeric_limits<float>::min()}));
    const auto gap = [&](std::size_t i) { return positions_[i + 1] - positions_[i]; };
    lowest_ = positions_.size() > 1 ? low - gap(0) : low - guard_;
    highest_ = positions_.size() > 1 ? high + gap(positions_.size() - 2) : high + guard_;
    std::size_t first = 0;
    while (first < positions_.size()) {
        // In a band with a single row, the gaps to the adjacent rows determine the precision of the snapping.
        float narrowest = positions_.size() == 1 ? guard_ : std::numeric_limits<float>::max();
        if (first > 0) narrowest = std::min(narrowest, gap(first - 1));
        if (first + 1 < positions_.size()) narrowest = std::min(narrowest, gap(first));
        float minGap = std::numeric_limits<float>::max();
        float maxGap = 0;
        std::size_t end = first + 1;
        for (; end < positions_.size() && end - first < kMaxBandRows; ++end) {
            const float next = gap(end - 1);
            GNOMON_CHECK(next > 0);
            if (std::max(maxGap, next) > kMaxGapRatio * std::min(minGap, next)) break;
            minGap = std::min(minGap, next);
            maxGap = std::max(maxGap, next);
        }
        addBand(first, end, end - first > 1 ? minGap : narrowest);
        first = end;
    }
}

void RowBands::addBand(std::size_t first, std::size_t end, float narrowest) {
    RowBand& band = bands_.emplace_back();
    band.first = firstRow_ + static_cast<int>(first);
    band.end = firstRow_ + static_cast<int>(end);
    band.base = positions_[first];
    while (band.bucketBits > kMinBucketBits && scaleFor(band.bucketBits, narrowest) * guard_ > kMaxUnits)
        --band.bucketBits;
    band.scale = scaleFor(band.bucketBits, narrowest);
    GNOMON_CHECK_OP(band.scale * guard_, <=, kMaxUnits);
    for (std::size_t i = first; i < end; ++i)
        band.rows.push_back(static_cast<std::int32_t>(std::lrint(band.units(positions_[i]))));
    const std::int32_t last = band.rows.back();
    std::int32_t row = 0;
    for (std::int32_t bucket = 0; bucket <= (last + 1) >> band.bucketBits; ++bucket) {
        while (row < band.count() && band.rows[static_cast<std::size_t>(row)] < bucket << band.bucketBits)
            ++row;
        band.rowsFromBucket.push_back(row);
    }
    band.rows.push_back(std::numeric_limits<std::int32_t>::max());
}

std::array<int, 2> RowBands::rowsBetween(float low, float high) const {
    const auto first = std::lower_bound(positions_.begin(), positions_.end(), low) - positions_.begin();
    const auto end = std::upper_bound(positions_.begin(), positions_.end(), high) - positions_.begin();
    const auto count = static_cast<std::ptrdiff_t>(positions_.size());
    return {
        firstRow_ + static_cast<int>(std::max<std::ptrdiff_t>(first - 1, 0)),
        firstRow_ + static_cast<int>(std::min(end + 1, count))};
}

} // namespace gnomon::raster
