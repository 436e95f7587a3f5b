// Measures the memory that a build of a source needs, if the estimate from the source's header exceeds the limit.
#pragma once

#include "core/progress.h"
#include "preprocess/pipeline/memory_plan.h"

namespace gnomon::pipeline {

/// Returns the memory that a build of `source` needs. The function makes passes over the source and measures the chunks
/// that the binning would create. The measurement itself needs memory. If it would exceed `memory`, the function
/// returns the need of the sorting phase instead, and the build checks the chunks later. If the sorting exceeds both
/// `memory` and the need of a small model, the function returns needs.peak().
Bytes countedNeed(read::MeshSource& source, const MemoryNeeds& needs, Bytes memory, Progress& progress);

} // namespace gnomon::pipeline
