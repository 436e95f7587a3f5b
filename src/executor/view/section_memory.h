// The cached sections of a model.
#pragma once

#include "executor/view/cap_buffers.h"
#include "executor/view/section_cut.h"
#include "executor/view/section_lines.h"

namespace gnomon::executor {

/// The cached sections of one model. The owner passes it with each frame that has sections.
struct SectionMemory {
    SectionCut cut;
    SectionLines lines;
    CapBuffers caps;
};

} // namespace gnomon::executor
