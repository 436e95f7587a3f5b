// Sorts a source into chunks: by ranges of its rows in tasks if the source supports them, otherwise in whole passes of
// one process.
#pragma once

#include "preprocess/pipeline/build_options.h"
#include "preprocess/pipeline/checkpoint_log.h"
#include "preprocess/pipeline/memory_plan.h"
#include "preprocess/pipeline/tasks/task.h"

#include <functional>
#include <optional>
#include <string>

namespace gnomon::pipeline {

/// The resources of the sorting. All must outlive it.
struct SortingMeans {
    read::MeshSource& source;
    const BuildOptions& options;
    scratch::ScratchFile& scratch;
    TaskRunner& runner;
    const Perform& perform;
    Progress& progress;
    std::size_t threads = 1;
    std::uint32_t processes = 1;
    // Receives the phase's name and the number of bytes read from the source.
    std::function<void(const std::string&, std::uint64_t)> endPhase;
};

/// Throws LimitError if `needed` exceeds the memory limit of `options`.
void requireMemory(const read::MeshSummary& source, const BuildOptions& options, Bytes needed);

/// Returns the memory limit minus `taken`.
Bytes remainingMemory(const BuildOptions& options, Bytes taken);

/// Sorts the source into chunks. Returns the record of the phase, and stores the chunks in `bins`.
BinnedRecord sortSource(const SortingMeans& means, std::optional<scratch::StreamStore>& bins);

} // namespace gnomon::pipeline
