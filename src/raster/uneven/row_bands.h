// Rows with uneven spacing, divided into bands. All rows of a band share the units to which vertices are snapped.
#pragma once

#include "raster/raster.h"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::raster {

/// Limits for the size of a bucket, as powers of two of units. Buckets find the rows of a band. Small buckets are for
/// gaps so narrow that larger units would overflow the exact edges.
constexpr int kMaxBucketBits = 8;
constexpr int kMinBucketBits = 4;

/// Max number of rows in a band, and max ratio between the widest and the narrowest gap in a band.
constexpr int kMaxBandRows = 256;
constexpr float kMaxGapRatio = 16;

/// A band: rows first to end - 1 of the target. In the band, y / w is snapped to whole units: the distance from `base`
/// times `scale`, rounded to nearest even. Two rows are more than a bucket apart, so a bucket contains at most one row.
/// A bucket has 256 units if possible: the finest rows are then snapped as precisely as an even grid.
struct RowBand {
    int first = 0;
    int end = 0;
    float base = 0;  // y / w of the first row
    float scale = 1; // a power of two
    int bucketBits = kMaxBucketBits;
    std::vector<std::int32_t> rows; // in units, followed by a sentinel that no vertex reaches
    /// By bucket b: the first row at or above bucket b, counted from the band's first row.
    std::vector<std::int32_t> rowsFromBucket;

    int count() const { return end - first; }

    /// Returns `position` in units, before rounding.
    float units(float position) const { return (position - base) * scale; }
};

/// Max |y / w| times scale. With columns within 2^24 of each other, an edge function then stays below 2^63.
constexpr float kMaxUnits = 0x1p36F;

/// The rows of a viewport, in bands.
class RowBands {
public:
    /// Sets the rows. `positions` are y / w of the rows, strictly increasing; `firstRow` is the index of the first one
    /// in the target. Gaps below 2^-30 of the largest |y / w| are too narrow for exact edges.
    void reset(std::span<const float> positions, int firstRow);

    std::span<const RowBand> bands() const { return bands_; }

    /// Returns the y / w below which a triangle touches no row; `highest` is the upper limit.
    float lowest() const { return lowest_; }

    float highest() const { return highest_; }

    /// Returns a power of two that is at least |y / w| of each row.
    float guard() const { return guard_; }

    /// Returns the half-open range of rows that a snapped triangle from `low` to `high` can touch, with one extra row
    /// at each side.
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
