// Prepares the last phase of a build. This phase writes the pages in their final order and then the tables of the file.
#pragma once

#include "hierarchy/model.h"
#include "preprocess/levels/level.h"
#include "preprocess/pipeline/checkpoint_log.h"

#include <functional>
#include <span>

namespace gnomon::pipeline {

/// The totals of a model, summed over all parts that were built separately (nodes).
struct Totals {
    hierarchy::ModelSummary summary;
    std::uint64_t pages = 0;
    std::uint64_t irreducibleTriangles = 0;
};

/// Returns the numbers of source triangles that the build dropped: degenerate, doubled, collapsed by the grid, covered.
DroppedCounts droppedTriangles(const CheckpointLog& log);

/// Returns the totals of a finished build from its checkpoint log. `options` are the options that affect the bytes of
/// the model. The summary contains them.
Totals totalsOf(const CheckpointLog& log, std::map<std::string, std::string> options);

/// Returns the rows of the page table for all pages, one span per node (part of the model that was built separately).
std::vector<std::span<const hierarchy::PageInfo>> pagesOf(const CheckpointLog& log);

/// Calls `take(page, position in the scratch file)` for all pages in the order of the model file: the coarsest level
/// first, and each level in the order of its nodes. The children of a page are final page ids. The offset of a page is
/// not final.
void forEachPage(const CheckpointLog& log, const std::function<void(const hierarchy::PageInfo&, std::uint64_t)>& take);

} // namespace gnomon::pipeline
