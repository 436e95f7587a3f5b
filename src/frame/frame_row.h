// The row of a frame in the log: the figures of its plan, cut, pages and drawing.
#pragma once

#include "frame/prepared_frame.h"
#include "render/backend.h"
#include "telemetry/frame_row.h"

#include <string>

namespace gnomon::frame {

/// The origin of a frame, for the log.
struct FrameSource {
    std::string model; // path of the model file
    std::string backend;
    lod::StoreStatistics residency; // after the pages of the frame were loaded
    Bytes trees{};                  // ray trees, stored in addition to the pages
};

/// Returns the row of a frame with the drawing cost `drawn`. The row lacks the total time and the results of a
/// validation.
telemetry::FrameRow frameRow(
    const PreparedFrame& frame, const render::DrawStatistics& drawn, const FrameSource& source);

} // namespace gnomon::frame
