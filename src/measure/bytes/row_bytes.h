// Rows of the log as bytes, in which they travel between processes.
#pragma once

#include "hierarchy/bytes.h"
#include "telemetry/frame_row.h"

#include <vector>

namespace gnomon::measure {

void putRows(hierarchy::ByteWriter& out, const std::vector<telemetry::FrameRow>& rows);

/// What `putRows` put. Throws hierarchy::Damage.
std::vector<telemetry::FrameRow> takeRows(hierarchy::ByteReader& in);

} // namespace gnomon::measure
