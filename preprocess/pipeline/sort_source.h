// Sorting a source into chunks: by ranges of its rows in tasks where it has them, else in whole passes of one process.
#pragma once

#include "preprocess/pipeline/build_options.h"
#include "preprocess/pipeline/checkpoint_log.h"
#include "preprocess/pipeline/memory_plan.h"
#include "preprocess/pipeline/tasks/task.h"

#include <functional>
#include <optional>
#include <string>

namespace gnomon::pipeline {

/// What it may use. All must outlive it.
struct SortingMeans {
    read::MeshSource& source;
    const BuildOptions& options;
    scratch::ScratchFile& scratch;
    TaskRunner& runner;
    const Perform& perform;
    Progress& progress;
    std::size_t threads = 1;
    std::uint32_t processes = 1;
    std::function<void(const std::string&, std::uint64_t)> endPhase; // gets its name, and what it read of the source
};

/// Throws LimitError if `needed` is more than `options` allow, for `source`.
void requireMemory(const read::MeshSummary& source, const BuildOptions& options, Bytes needed);

/// What of the memory is left beside `taken`.
Bytes roomBeside(const BuildOptions& options, Bytes taken);

/// The record of it; what is in chunks is in `bins`.
BinnedRecord sortSource(const SortingMeans& means, std::optional<scratch::StreamStore>& bins);

} // namespace gnomon::pipeline
