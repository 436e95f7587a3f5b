// Draws the user's measurements over the image: their points, lines and results.
#pragma once

#include "viewer/measuring.h"
#include "viewer/panel/wire_frames.h"

namespace gnomon::viewer {

/// Submits the points, lines and results of `measuring` to Dear ImGui, as `camera` sees them. The text is above
/// `linesBelow` lines of other notes. Lines are visible even if geometry hides the points.
void drawMeasures(const Measuring& measuring, const Camera& camera, std::size_t linesBelow);

} // namespace gnomon::viewer
