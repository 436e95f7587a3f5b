// Rows of samples that lie unevenly, in bands of rows that vertices are snapped alike for.
#pragma once

#include "raster/raster.h"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::raster {

/// Rows of a band are found by buckets of so many units, as powers of two: the fewest where gaps are so narrow that
/// more would leave no room for exact edges.
constexpr int kMostBucketBits = 8;
constexpr int kLeastBucketBits = 4;

/// A band has at most this many rows, and its widest gap between rows is at most this many times its narrowest.
constexpr int kMostBandRows = 256;
constexpr float kMostGapRatio = 16;

/// Rows first to end - 1 of the target. In the band y / w is snapped to whole units: the distance from `base` times
/// `scale`, rounded to the nearest even. There is more than a bucket between two rows, so at most one row in a bucket:
/// of 256 units, so that the finest rows are snapped as finely as those of an even grid, or of fewer.
struct RowBand {
    int first = 0;
    int end = 0;
    float base = 0;  // of the first row
    float scale = 1; // a power of two
    int bucketBits = kMostBucketBits;
    std::vector<std::int32_t> rows;           // in units; behind them one that nothing reaches
    std::vector<std::int32_t> rowsFromBucket; // the first row, from the band's first, of b buckets or more

    int count() const { return end - first; }

    /// The units of `position`, before they are rounded.
    float units(float position) const { return (position - base) * scale; }
};

/// Largest |y / w| times scale: with columns within 2^24 of each other an edge then stays under 2^63.
constexpr float kMostUnits = 0x1p36F;

/// The rows of a viewport.
class RowBands {
public:
    /// `positions` of the rows from `firstRow` of the target on, in y / w, strictly increasing. Narrower gaps than
    /// 2^-30 of the largest |y / w| leave no room for exact edges.
    void reset(std::span<const float> positions, int firstRow);

    std::span<const RowBand> bands() const { return bands_; }

    /// What lies below or above these touches no row.
    float lowest() const { return lowest_; }

    float highest() const { return highest_; }

    /// A power of two that no |y / w| of a row is above.
    float guard() const { return guard_; }

    /// The rows, half-open, that something from `low` to `high` can touch once it is snapped: one more on each side.
    std::array<int, 2> rowsBetween(float low, float high) const;

private:
    void addBand(std::size_t first, std::size_t end, float narrowest);

    std::vector<float> positions_;
    std::vector<RowBand> bands_;
    int firstRow_ = 0;
    float guard_ = 1;
    float lowest_ = 0;
    float highest_ = 0;
};

} // namespace gnomon::raster
