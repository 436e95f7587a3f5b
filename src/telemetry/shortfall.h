// How far pictures miss the error that was asked for, and the one sentence that says so.
#pragma once

#include "telemetry/frame_row.h"

#include <cstdint>
#include <string>

namespace gnomon::telemetry {

/// What one drawing was asked for, and what it got.
struct DrawnDetail {
    double askedPixels = 0;         // max error that was asked for
    double achievedPixels = 0;      // max error of anything that is drawn
    std::uint64_t pagesMissing = 0; // of the image and of its casters
    bool isDamaged = false;         // pages cannot be read; the user has been told of each
};

/// Collects what the drawings of one command miss.
class Shortfall {
public:
    void add(const DrawnDetail& detail);

    /// Adds a row of the log.
    void add(const FrameRow& row);

    /// One sentence about all drawings, with the likely cause; empty if each has the error and the pages that it was
    /// asked for. Damaged pages do not count: the user has been told of each.
    std::string text() const;

private:
    bool isAny_ = false;
    DrawnDetail worst_; // the largest figures of all drawings that miss something
};

} // namespace gnomon::telemetry
