// Prepares the last phase of a build, which writes the pages in their final order and then the tables of the file.
#pragma once

#include "hierarchy/model.h"
#include "preprocess/levels/level.h"
#include "preprocess/pipeline/checkpoint_log.h"

#include <functional>
#include <span>

namespace gnomon::pipeline {

/// The totals of a model, added up over the records of all nodes.
struct Totals {
    hierarchy::ModelSummary summary;
    std::uint64_t pages = 0;
    std::uint64_t irreducibleTriangles = 0;
};

/// Returns the numbers of dropped source triangles: degenerate, doubled, collapsed by the grid, covered.
DroppedCounts droppedTriangles(const CheckpointLog& log);

/// Returns the totals of a build. `options` are the options that affect the bytes of the model; the summary contains
/// them.
Totals totalsOf(const CheckpointLog& log, std::map<std::string, std::string> options);

/// Returns the page table rows of all pages, one span per node.
std::vector<std::span<const hierarchy::PageInfo>> pagesOf(const CheckpointLog& log);

/// Calls `take(page, place in the scratch file)` for all pages in file order: the coarsest level first, and each level
/// in the order of its nodes. The children of a page are final page ids. The offset of a page is not final.
void forEachPage(const CheckpointLog& log, const std::function<void(const hierarchy::PageInfo&, std::uint64_t)>& take);

} // namespace gnomon::pipeline
