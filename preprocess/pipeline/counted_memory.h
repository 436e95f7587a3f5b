// The memory that a source needs as its triangles tell it, where the header's figure is too large.
#pragma once

#include "core/progress.h"
#include "preprocess/pipeline/memory_plan.h"

namespace gnomon::pipeline {

/// Returns the memory that `source` needs: its chunks are measured as binning will find them, in passes over the
/// source. Measuring takes memory of its own. If that is more than `memory`, the result is what sorting needs, and
/// whether the chunks fit is known once they are there; if sorting does not fit, more than a small model takes, it is
/// needs.most().
Bytes countedNeed(read::MeshSource& source, const MemoryNeeds& needs, Bytes memory, Progress& progress);

} // namespace gnomon::pipeline
