// The cached section cuts and section lines of a model.
#pragma once

#include "render/view/cap_buffers.h"
#include "render/view/section_cut.h"
#include "render/view/section_lines.h"

namespace gnomon::render {

/// The cached section cuts and section lines of one model. The owner passes this object with each frame that has
/// sections.
struct SectionMemory {
    SectionCut cut;
    SectionLines lines;
    CapBuffers caps;
};

} // namespace gnomon::render
