// The last phase: pages in their final order, then the tables.
#pragma once

#include "core/progress.h"
#include "hierarchy/model_writer.h"
#include "preprocess/levels/level.h"
#include "preprocess/pipeline/checkpoint_log.h"
#include "preprocess/scratch/scratch_file.h"

#include <functional>
#include <span>

namespace gnomon::pipeline {

/// What the records of all nodes add up to.
struct Totals {
    hierarchy::ModelSummary summary;
    std::uint64_t pages = 0;
    std::uint64_t stuckTriangles = 0;
};

/// The source's triangles that are left out: degenerate, doubled, collapsed by the grid.
std::array<std::uint64_t, 3> droppedTriangles(const CheckpointLog& log);

/// `options` are those of the build that change bytes.
Totals totalsOf(const CheckpointLog& log, std::map<std::string, std::string> options);

/// The rows of all pages, in parts.
std::vector<std::span<const hierarchy::PageInfo>> pagesOf(const CheckpointLog& log);

/// Appends all pages to `writer`, coarsest level first, each level in the order of the nodes; `onPage` sees each.
void writePages(
    const CheckpointLog& log,
    const scratch::ScratchFile& pages,
    hierarchy::ModelWriter& writer,
    Progress& progress,
    const std::function<void(const hierarchy::EncodedPage&)>& onPage);

} // namespace gnomon::pipeline
