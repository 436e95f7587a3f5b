// The pages of a model, from scratch files to their places: by this process, or by all that build it.
#pragma once

#include "core/progress.h"
#include "hierarchy/model_writer.h"
#include "preprocess/pipeline/checkpoint_log.h"
#include "preprocess/pipeline/tasks/task.h"
#include "preprocess/scratch/scratch_file.h"

#include <functional>

namespace gnomon::pipeline {

/// Where pages come from and go to.
struct PagesToWrite {
    const CheckpointLog& log;
    const scratch::ScratchFile& scratch;
    hierarchy::ModelWriter& writer;
    Progress& progress;
    std::function<bool(const hierarchy::PageInfo&)> isSeen; // whether `see` wants a page
    std::function<void(const hierarchy::EncodedPage&)> see;
};

/// Appends all to the writer.
void appendPages(const PagesToWrite& pages);

/// Has them written by tasks of `runner`, a range of the file each, some for each of `processes`; the writer must have
/// an unfinished file, which messages call `toldPath`.
void writePagesInTasks(
    const PagesToWrite& pages,
    const std::string& toldPath,
    std::uint32_t processes,
    TaskRunner& runner,
    const Perform& perform);

} // namespace gnomon::pipeline
