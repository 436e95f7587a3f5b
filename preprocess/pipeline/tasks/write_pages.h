// Copies the pages of a model from scratch files to the model file. Either one process or all processes copy pages.
#pragma once

#include "core/progress.h"
#include "hierarchy/model_writer.h"
#include "preprocess/pipeline/checkpoint_log.h"
#include "preprocess/pipeline/tasks/task.h"
#include "preprocess/scratch/scratch_file.h"

#include <functional>

namespace gnomon::pipeline {

/// The pages to copy and their order (the checkpoint log), their scratch file, and the model file.
struct PagesToWrite {
    const CheckpointLog& log;
    const scratch::ScratchFile& scratch;
    hierarchy::ModelWriter& writer;
    Progress& progress;
    std::function<bool(const hierarchy::PageInfo&)> isSeen; // returns true if `see` must receive the page
    std::function<void(const hierarchy::EncodedPage&)> see;
};

/// Appends all pages of the model to the model file, in order.
void appendPages(const PagesToWrite& pages);

/// Writes all pages to the model file with tasks of `runner`. Each task writes a range of the file, and each process
/// runs several tasks. The writer must have an unfinished file. Error messages call the file `displayPath`.
void writePagesInTasks(
    const PagesToWrite& pages,
    const std::string& displayPath,
    std::uint32_t processes,
    TaskRunner& runner,
    const Perform& perform);

} // namespace gnomon::pipeline
