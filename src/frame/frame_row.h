// The row of a frame in the log: the statistics of its plan, cut, pages and drawing.
#pragma once

#include "frame/prepared_frame.h"
#include "render/backend.h"
#include "telemetry/frame_row.h"

#include <string>

namespace gnomon::frame {

/// The origin of a frame and the memory that it used, for the log.
struct FrameSource {
    std::string model; // path of the model file
    std::string backend;
    lod::StoreStatistics residency; // state of the pages after the frame loaded its pages
    Bytes trees{};                  // memory of the ray-tracing trees, in addition to the pages
};

/// Returns the row of `frame` for the log. `drawn` is the cost of its drawing. The caller adds the total time and the
/// results of a validation.
telemetry::FrameRow frameRow(
    const PreparedFrame& frame, const render::DrawStatistics& drawn, const FrameSource& source);

} // namespace gnomon::frame
