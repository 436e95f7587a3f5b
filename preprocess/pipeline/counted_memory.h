// Measures the memory that a build of a source mesh needs. This is necessary if the estimate from the source's header
// exceeds the memory limit.
#pragma once

#include "core/progress.h"
#include "preprocess/pipeline/memory_plan.h"

namespace gnomon::pipeline {

/// Returns the memory that a build of `source` needs. The function makes passes over the source and measures the chunks
/// that the build would create. The measurement itself needs memory. If it would exceed the limit `memory`, the
/// function returns the memory of the sorting phase instead, and the build checks the chunks later. If the sorting
/// exceeds both `memory` and the memory of a small model, the function returns needs.peak().
Bytes countedNeed(read::MeshSource& source, const MemoryNeeds& needs, Bytes memory, Progress& progress);

} // namespace gnomon::pipeline
