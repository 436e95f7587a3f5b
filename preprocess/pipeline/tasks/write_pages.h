// Writes the pages of a model from scratch files to their places in the file, by this process or by all processes.
#pragma once

#include "core/progress.h"
#include "hierarchy/model_writer.h"
#include "preprocess/pipeline/checkpoint_log.h"
#include "preprocess/pipeline/tasks/task.h"
#include "preprocess/scratch/scratch_file.h"

#include <functional>

namespace gnomon::pipeline {

/// The source and the destination of the pages.
struct PagesToWrite {
    const CheckpointLog& log;
    const scratch::ScratchFile& scratch;
    hierarchy::ModelWriter& writer;
    Progress& progress;
    std::function<bool(const hierarchy::PageInfo&)> isSeen; // whether `see` needs a page
    std::function<void(const hierarchy::EncodedPage&)> see;
};

/// Appends all pages to the writer.
void appendPages(const PagesToWrite& pages);

/// Writes all pages with tasks of `runner`, one per range of the file, several per process. The writer must have an
/// unfinished file. Messages call it `displayPath`.
void writePagesInTasks(
    const PagesToWrite& pages,
    const std::string& displayPath,
    std::uint32_t processes,
    TaskRunner& runner,
    const Perform& perform);

} // namespace gnomon::pipeline
