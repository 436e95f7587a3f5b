// The row of the log that a frame leaves: what was planned, cut, resident and drawn, in the log's columns.
#pragma once

#include "executor/executor.h"
#include "frame/prepared_frame.h"
#include "telemetry/frame_row.h"

#include <string>

namespace gnomon::frame {

/// Where a frame came from, as its row names it.
struct FrameSource {
    std::string model; // path
    std::string executor;
    streaming::StoreStatistics residency; // once its pages were there
    Bytes trees{};                        // of rays, kept beside those pages
};

/// The row of a frame that took `drawn` to draw; without its total time, and without what a proof finds out.
telemetry::FrameRow frameRow(
    const PreparedFrame& frame, const executor::DrawStatistics& drawn, const FrameSource& source);

} // namespace gnomon::frame
