// Measures the memory that a source needs, if the estimate from its header is too high.
#pragma once

#include "core/progress.h"
#include "preprocess/pipeline/memory_plan.h"

namespace gnomon::pipeline {

/// Returns the memory that a build of `source` needs. The function makes passes over the source and measures its chunks
/// as the binning will create them. The measurement itself needs memory. If that exceeds `memory`, the function returns
/// the need of the sorting phase, and the build checks the chunks later. If the sorting exceeds both `memory` and the
/// need of a small model, the function returns needs.peak().
Bytes countedNeed(read::MeshSource& source, const MemoryNeeds& needs, Bytes memory, Progress& progress);

} // namespace gnomon::pipeline
