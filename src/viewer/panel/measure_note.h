// Draws measures over the image: their points, lines and results.
#pragma once

#include "viewer/measuring.h"
#include "viewer/panel/wire_frames.h"

namespace gnomon::viewer {

/// Describes `measuring` for Dear ImGui, as `camera` sees it. The text is above `linesBelow` lines of other notes.
/// Lines are visible even if geometry hides the points.
void drawMeasures(const Measuring& measuring, const Camera& camera, std::size_t linesBelow);

} // namespace gnomon::viewer
