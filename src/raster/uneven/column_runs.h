// Columns of samples that lie in runs of even ones: each run has a grid of its own, which vertices are snapped for.
#pragma once

#include "raster/raster.h"

#include <array>
#include <span>
#include <vector>

namespace gnomon::raster {

/// Columns first to end - 1 of the target; in the run column = x / w * scale + offset.
struct ColumnBand {
    int first = 0;
    int end = 0;
    float scale = 1;
    float offset = 0;
};

/// The columns of a viewport.
class ColumnRuns {
public:
    /// `runs` as View has them, of a viewport whose first column is `firstColumn`. Their scales times |x / w| of what
    /// lies in the viewport are at most 2^17. Vertices are left whole up to about `guardPixels` of the densest run.
    void reset(std::span<const ColumnRun> runs, int firstColumn, float guardPixels);

    bool empty() const { return bands_.empty(); }

    std::span<const ColumnBand> bands() const { return bands_; }

    /// What lies left or right of these x / w touches no column.
    float lowest() const { return lowest_; }

    float highest() const { return highest_; }

    /// A power of two that no |x / w| of a column is above.
    float guard() const { return guard_; }

    /// The columns, half-open, that something from `low` to `high` can touch once it is snapped.
    std::array<int, 2> columnsBetween(float low, float high) const;

private:
    std::vector<ColumnBand> bands_;
    float lowest_ = -1;
    float highest_ = 1;
    float guard_ = 1;
};

} // namespace gnomon::raster
