// The caches for the section planes of a model: clipped clusters and intersection lines.
#pragma once

#include "render/view/cap_buffers.h"
#include "render/view/section_cut.h"
#include "render/view/section_lines.h"

namespace gnomon::render {

/// The caches of clipped clusters and intersection lines for one model. The caller passes this object with each frame
/// that has section planes.
struct SectionMemory {
    SectionCut cut;
    SectionLines lines;
    CapBuffers caps;
};

} // namespace gnomon::render
