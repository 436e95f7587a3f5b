// The rows of a logarithmic shadow map, divided into bands. Each band has its own unit to which the rasteriser snaps
// y.
#pragma once

#include "raster/raster.h"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::raster {

/// Max and min size of a bucket, as powers of two of units. A bucket is a range of y / w that is used to find the rows
/// of a band. Small buckets are for very narrow gaps between rows, where larger buckets would overflow the exact edge
/// functions.
constexpr int kMaxBucketBits = 8;
constexpr int kMinBucketBits = 4;

/// Limits of a band of rows: the max number of rows, and the max ratio between the widest and the narrowest gap between
/// adjacent rows.
constexpr int kMaxBandRows = 256;
constexpr float kMaxGapRatio = 16;

/// A band of rows `first` to `end` - 1 of a logarithmic shadow map. In the band, y / w is snapped to whole units: (y /
/// w - base) * scale, rounded to nearest even. Adjacent rows are more than one bucket apart, so a bucket contains at
/// most one row. If possible, a bucket has 256 units. Vertices near the narrowest gap are then snapped as precisely as
/// with evenly spaced rows.
struct RowBand {
    int first = 0;
    int end = 0;
    float base = 0;  // y / w of the first row
    float scale = 1; // a power of two
    int bucketBits = kMaxBucketBits;
    std::vector<std::int32_t> rows; // positions of the rows in units, followed by a sentinel above all vertices
    /// For each bucket of the band: the first row at or above the start of the bucket, counted from the band's first
    /// row.
    std::vector<std::int32_t> rowsFromBucket;

    int count() const { return end - first; }

    /// Converts the row coordinate `position` (y / w) to units of the band, without rounding.
    float units(float position) const { return (position - base) * scale; }
};

/// Max |y / w| times scale of a band. If columns are within 2^24 of each other, an edge function is then below 2^63.
constexpr float kMaxUnits = 0x1p36F;

/// The rows of a logarithmic shadow map, divided into bands.
class RowBands {
public:
    /// Sets the rows of the map. `positions` contains y / w of each row, strictly increasing. `firstRow` is the index
    /// of the first row in the target. Gaps below 2^-30 of the largest |y / w| are too narrow for exact edge functions.
    void reset(std::span<const float> positions, int firstRow);

    std::span<const RowBand> bands() const { return bands_; }

    /// Returns the lower limit of y / w. Triangles below this limit cover no row. `highest` returns the upper limit.
    float lowest() const { return lowest_; }

    float highest() const { return highest_; }

    /// Returns a power of two that is at least as large as |y / w| of each row.
    float guard() const { return guard_; }

    /// Returns the first row and the end (exclusive) of the rows that a triangle with y / w from `low` to `high` can
    /// cover. The range includes one extra row at each side.
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
