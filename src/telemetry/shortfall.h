// Collects how much drawn frames exceed the requested error or lack pages, and words the warning.
#pragma once

#include "telemetry/frame_row.h"

#include <cstdint>
#include <string>

namespace gnomon::telemetry {

/// The requested and the achieved detail of one drawn frame.
struct DrawnDetail {
    double askedPixels = 0;         // requested max error, in pixels
    double achievedPixels = 0;      // max error of the drawn clusters, in pixels
    std::uint64_t pagesMissing = 0; // missing pages of the image and of its casters
    bool isDamaged = false;         // some pages cannot be read; a warning was printed for each
};

/// Collects over all frames of a command how much they exceed the requested error or lack pages.
class Shortfall {
public:
    void add(const DrawnDetail& detail);

    /// Adds the achieved detail of the frame that a log row describes.
    void add(const FrameRow& row);

    /// Returns one sentence about all frames that exceed the requested error or lack pages, with the likely cause.
    /// Returns an empty text if there are none. Damaged pages do not count, because each one has its own warning.
    std::string text() const;

    /// Returns true if frames lack pages because the memory for pages is too small.
    bool lacksMemory() const { return worst_.pagesMissing > 0; }

private:
    bool isAny_ = false;
    DrawnDetail worst_; // the largest shortfall of all drawings
};

} // namespace gnomon::telemetry
