// Copies the pages of a model from scratch files to their places in the model file. One process or all processes copy.
#pragma once

#include "core/progress.h"
#include "hierarchy/model_writer.h"
#include "preprocess/pipeline/checkpoint_log.h"
#include "preprocess/pipeline/tasks/task.h"
#include "preprocess/scratch/scratch_file.h"

#include <functional>

namespace gnomon::pipeline {

/// The scratch file with the pages, their order, and the model file.
struct PagesToWrite {
    const CheckpointLog& log;
    const scratch::ScratchFile& scratch;
    hierarchy::ModelWriter& writer;
    Progress& progress;
    std::function<bool(const hierarchy::PageInfo&)> isSeen; // returns whether `see` must receive a page
    std::function<void(const hierarchy::EncodedPage&)> see;
};

/// Appends all pages to the model file.
void appendPages(const PagesToWrite& pages);

/// Writes all pages with tasks of `runner`. Each task writes a range of the file, and each process runs several tasks.
/// The writer must have an unfinished file. Error messages call the file `displayPath`.
void writePagesInTasks(
    const PagesToWrite& pages,
    const std::string& displayPath,
    std::uint32_t processes,
    TaskRunner& runner,
    const Perform& perform);

} // namespace gnomon::pipeline
