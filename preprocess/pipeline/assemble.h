// The last phase of a build: the pages in their final order, then the tables.
#pragma once

#include "hierarchy/model.h"
#include "preprocess/levels/level.h"
#include "preprocess/pipeline/checkpoint_log.h"

#include <functional>
#include <span>

namespace gnomon::pipeline {

/// The totals over the records of all nodes.
struct Totals {
    hierarchy::ModelSummary summary;
    std::uint64_t pages = 0;
    std::uint64_t irreducibleTriangles = 0;
};

/// Returns the numbers of dropped source triangles: degenerate, doubled, collapsed by the grid, covered.
DroppedCounts droppedTriangles(const CheckpointLog& log);

/// Returns the totals of a build. `options` are the options that affect the bytes of the model.
Totals totalsOf(const CheckpointLog& log, std::map<std::string, std::string> options);

/// Returns the rows of all pages, in parts.
std::vector<std::span<const hierarchy::PageInfo>> pagesOf(const CheckpointLog& log);

/// Calls `take(page, place in the scratch file)` for all pages in file order: coarsest level first, each level in node
/// order. The children of a page are final ids. Its offset is not final.
void forEachPage(const CheckpointLog& log, const std::function<void(const hierarchy::PageInfo&, std::uint64_t)>& take);

} // namespace gnomon::pipeline
