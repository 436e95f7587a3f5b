// The least memory of a source as its triangles tell it, where the header's figure is refused.
#pragma once

#include "core/progress.h"
#include "preprocess/pipeline/memory_plan.h"

namespace gnomon::pipeline {

/// The least memory that builds `source`, never less than `needs.least()`: its chunks are measured as binning will find
/// them, in passes over the source. That takes memory of its own; where it would take more than `memory` and more than
/// a small model does, the header's figure stands.
Bytes countedLeast(read::MeshSource& source, const MemoryNeeds& needs, Bytes memory, Progress& progress);

} // namespace gnomon::pipeline
