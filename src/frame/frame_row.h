// Writes the row of a frame in the log: the statistics of its plan, clusters, pages and drawing.
#pragma once

#include "frame/prepared_frame.h"
#include "render/backend.h"
#include "telemetry/frame_row.h"

#include <string>

namespace gnomon::frame {

/// The model file of a frame and the memory that the frame used, for the log.
struct FrameSource {
    std::string model; // path of the model file
    std::string backend;
    lod::StoreStatistics residency; // page memory after the frame loaded its pages
    Bytes trees{};                  // memory of the ray-tracing trees, which is not part of the page memory
};

/// Returns the log row of `frame`, with the times and counts `drawn` of its drawing. The caller adds the total time and
/// the results of a validation.
telemetry::FrameRow frameRow(
    const PreparedFrame& frame, const render::DrawStatistics& drawn, const FrameSource& source);

} // namespace gnomon::frame
