// How far drawings fall short of the requested error, and the warning about it.
#pragma once

#include "telemetry/frame_row.h"

#include <cstdint>
#include <string>

namespace gnomon::telemetry {

/// The requested and the achieved detail of one drawing.
struct DrawnDetail {
    double askedPixels = 0;         // requested max error, in pixels
    double achievedPixels = 0;      // max error of the drawn clusters, in pixels
    std::uint64_t pagesMissing = 0; // missing pages of the image and of its casters
    bool isDamaged = false;         // some pages cannot be read; a warning was printed for each
};

/// Collects the shortfalls of all drawings of one command.
class Shortfall {
public:
    void add(const DrawnDetail& detail);

    /// Adds the values of a log row.
    void add(const FrameRow& row);

    /// Returns one sentence about all drawings, with the likely cause. Returns an empty text if each drawing has the
    /// requested error and pages. Damaged pages do not count, because each one has its own warning.
    std::string text() const;

    /// Returns true if pages are missing because the page memory is too small.
    bool lacksMemory() const { return worst_.pagesMissing > 0; }

private:
    bool isAny_ = false;
    DrawnDetail worst_; // the largest shortfall of all drawings
};

} // namespace gnomon::telemetry
