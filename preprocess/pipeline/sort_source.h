// Sorts a source into chunks. If the source supports ranges of rows, tasks sort one range each. Otherwise one process
// sorts the source in whole passes.
#pragma once

#include "preprocess/pipeline/build_options.h"
#include "preprocess/pipeline/checkpoint_log.h"
#include "preprocess/pipeline/memory_plan.h"
#include "preprocess/pipeline/tasks/task.h"

#include <functional>
#include <optional>
#include <string>

namespace gnomon::pipeline {

/// The objects that the sorting uses. All must outlive it.
struct SortingMeans {
    read::MeshSource& source;
    const BuildOptions& options;
    scratch::ScratchFile& scratch;
    TaskRunner& runner;
    const Perform& perform;
    Progress& progress;
    std::size_t threads = 1;
    std::uint32_t processes = 1;
    // Is called at the end of each phase with its name and the number of bytes that it read from the source.
    std::function<void(const std::string&, std::uint64_t)> endPhase;
};

/// Throws LimitError if `needed` exceeds the memory limit in `options`.
void requireMemory(const read::MeshSummary& source, const BuildOptions& options, Bytes needed);

/// Returns the memory limit in `options` minus `taken`, or zero.
Bytes remainingMemory(const BuildOptions& options, Bytes taken);

/// Sorts the source into chunks and stores the chunks in `bins`. Returns the record of the phase.
BinnedRecord sortSource(const SortingMeans& means, std::optional<scratch::StreamStore>& bins);

} // namespace gnomon::pipeline
