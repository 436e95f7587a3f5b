// The rows of a logarithmic map, divided into bands. All rows of a band share the units to which y is snapped.
#pragma once

#include "raster/raster.h"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::raster {

/// Max and min size of a bucket, as powers of two of units. A bucket is a range of y / w that is used to find the rows
/// of a band. Small buckets are for very narrow gaps, where larger buckets would overflow the exact edge functions.
constexpr int kMaxBucketBits = 8;
constexpr int kMinBucketBits = 4;

/// Max number of rows in a band. kMaxGapRatio is the max ratio between the widest and the narrowest gap between rows in
/// a band.
constexpr int kMaxBandRows = 256;
constexpr float kMaxGapRatio = 16;

/// A band of rows: rows `first` to `end` - 1 of the target. In the band, y / w is snapped to whole units: (y / w -
/// base) * scale, rounded to nearest even. Two rows are more than one bucket apart, so a bucket contains at most one
/// row. If possible, a bucket has 256 units. Vertices near the narrowest gap are then snapped as precisely as with
/// evenly spaced rows.
struct RowBand {
    int first = 0;
    int end = 0;
    float base = 0;  // y / w of the first row
    float scale = 1; // a power of two
    int bucketBits = kMaxBucketBits;
    std::vector<std::int32_t> rows; // positions of the rows in units, followed by a sentinel above all vertices
    /// For each bucket b: the first row at or above the start of bucket b, counted from the band's first row.
    std::vector<std::int32_t> rowsFromBucket;

    int count() const { return end - first; }

    /// Returns `position` (y / w) in units of the band, before rounding.
    float units(float position) const { return (position - base) * scale; }
};

/// Max |y / w| times scale. If columns are within 2^24 of each other, an edge function is then below 2^63.
constexpr float kMaxUnits = 0x1p36F;

/// The rows of the viewport of a logarithmic map, divided into bands.
class RowBands {
public:
    /// Sets the rows. `positions` contains y / w of the rows, strictly increasing. `firstRow` is the index of the first
    /// row in the target. Gaps below 2^-30 of the largest |y / w| are too narrow for exact edge functions.
    void reset(std::span<const float> positions, int firstRow);

    std::span<const RowBand> bands() const { return bands_; }

    /// Returns the y / w below which a triangle touches no row. `highest` returns the y / w above which it touches no
    /// row.
    float lowest() const { return lowest_; }

    float highest() const { return highest_; }

    /// Returns a power of two that is at least |y / w| of each row.
    float guard() const { return guard_; }

    /// Returns the range of rows that a snapped triangle with y / w from `low` to `high` can touch, without its upper
    /// end. The range includes one extra row at each side.
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
