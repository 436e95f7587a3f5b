// The last phase: pages in their final order, then the tables.
#pragma once

#include "hierarchy/model.h"
#include "preprocess/levels/level.h"
#include "preprocess/pipeline/checkpoint_log.h"

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
DroppedCounts droppedTriangles(const CheckpointLog& log);

/// `options` are those of the build that change bytes.
Totals totalsOf(const CheckpointLog& log, std::map<std::string, std::string> options);

/// The rows of all pages, in parts.
std::vector<std::span<const hierarchy::PageInfo>> pagesOf(const CheckpointLog& log);

/// Calls `take(page, place in the scratch file)` for all pages in the order of the file: coarsest level first, each
/// level in the order of the nodes. Children are those of the file, the offset is not.
void forEachPage(const CheckpointLog& log, const std::function<void(const hierarchy::PageInfo&, std::uint64_t)>& take);

} // namespace gnomon::pipeline
