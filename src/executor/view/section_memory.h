// What is kept of a model's sections from frame to frame.
#pragma once

#include "executor/view/cap_buffers.h"
#include "executor/view/section_cut.h"
#include "executor/view/section_lines.h"

namespace gnomon::executor {

/// Of one model; whoever draws it has one, and frames of it that have sections name it.
struct SectionMemory {
    SectionCut cut;
    SectionLines lines;
    CapBuffers caps;
};

} // namespace gnomon::executor
