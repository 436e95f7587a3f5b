// What the colours of an overlay mean, and its drawing into a picture.
#pragma once

#include "executor/executor.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::executor {

/// A colour and what it stands for.
struct LegendEntry {
    glm::vec3 color{0};
    std::string text;
    bool isStriped = false; // as what has no map is painted
};

/// The legend of one picture.
struct Legend {
    std::vector<std::string> title; // lines
    bool hasHeatScale = false;      // the colours of the factors from 1/4 to 16
    std::optional<double> mark;     // on that scale, what was promised
    std::vector<LegendEntry> entries;
};

/// What `overlay` shows of a frame of `plan`; nothing for Overlay::None. Depths are in the model's units, along the
/// view.
Legend legendOf(Overlay overlay, const plan::FramePlan& plan);

/// Draws `legend` into the lower left corner, in letters of two or of one pixel a dot as they fit. Pictures too small
/// for it stay as they are, and any for an empty one.
void drawLegend(Picture& picture, const Legend& legend);

} // namespace gnomon::executor
