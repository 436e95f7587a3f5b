// Sorts a source into chunks. If ranges of the source's rows are readable, tasks sort one range each. Otherwise one
// process sorts the source in passes over the whole file.
#pragma once

#include "preprocess/pipeline/build_options.h"
#include "preprocess/pipeline/checkpoint_log.h"
#include "preprocess/pipeline/memory_plan.h"
#include "preprocess/pipeline/tasks/task.h"

#include <functional>
#include <optional>
#include <string>

namespace gnomon::pipeline {

/// The source, the options and the other objects for sorting a source into chunks. All must outlive the sorting.
struct SortingMeans {
    read::MeshSource& source;
    const BuildOptions& options;
    scratch::ScratchFile& scratch;
    TaskRunner& runner;
    const Perform& perform;
    Progress& progress;
    std::size_t threads = 1;
    std::uint32_t processes = 1;
    // This function is called at the end of each phase. Its arguments are the name of the phase and the number of bytes
    // that the phase read from the source.
    std::function<void(const std::string&, std::uint64_t)> endPhase;
};

/// Throws LimitError if the memory `needed` exceeds the limit in `options`.
void requireMemory(const read::MeshSummary& source, const BuildOptions& options, Bytes needed);

/// Returns the memory limit in `options` minus the memory `taken`, or zero if the difference is negative.
Bytes remainingMemory(const BuildOptions& options, Bytes taken);

/// Sorts the source into chunks and writes the chunks to `bins`. Returns the checkpoint record of this phase.
BinnedRecord sortSource(const SortingMeans& means, std::optional<scratch::StreamStore>& bins);

} // namespace gnomon::pipeline
