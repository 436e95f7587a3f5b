// Cracks of random view-dependent cuts: edges locked between groups that do not fit together.
#pragma once

#include "preprocess/verify/check.h"
#include "preprocess/verify/crack_cells.h"
#include "preprocess/verify/loaded_model.h"
#include "preprocess/verify/model_facts.h"

namespace gnomon::verify {

/// Draws `cuts` random view-dependent cuts (a group is refined if its error exceeds threshold times distance to the
/// eye) and looks at every edge that was locked at a level (locked_edges.h), in each cut that draws a triangle of the
/// surface of that level or the next coarser one at it: the number of triangles at the edge, compared by position, must
/// be that of the level. Worst: the most cracks in one cut.
Check checkCracks(const LoadedModel& model, std::uint64_t cuts, std::uint64_t seed, Progress& progress);

/// The same of a file, `facts` of which are given, one of `cells`, which crackCells returns, after the other. The
/// result is the same, but perhaps for which of several cracks of a cut is told.
Check checkCracks(
    const hierarchy::ModelFile& file,
    const ModelFacts& facts,
    std::uint64_t cuts,
    std::uint64_t seed,
    std::span<const CrackCell> cells,
    Progress& progress);

/// What `cuts` cuts take beside the cells, in bytes.
std::uint64_t cutBytes(std::uint64_t cuts);

} // namespace gnomon::verify
