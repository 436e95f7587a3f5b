// Measures over the picture: their points and lines, and what they come to.
#pragma once

#include "viewer/measuring.h"
#include "viewer/panel/wire_frames.h"

namespace gnomon::viewer {

/// Describes `measuring` for Dear ImGui, as `camera` sees it, its figures above `linesBelow` lines of other notes; what
/// hides the points does not hide their lines.
void drawMeasures(const Measuring& measuring, const Camera& camera, std::size_t linesBelow);

} // namespace gnomon::viewer
