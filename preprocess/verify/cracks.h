// Finds cracks in random view-dependent cuts: locked edges between groups that do not match.
#pragma once

#include "preprocess/verify/check.h"
#include "preprocess/verify/crack_cells.h"
#include "preprocess/verify/loaded_model.h"
#include "preprocess/verify/model_facts.h"

namespace gnomon::verify {

/// Draws `cuts` random view-dependent cuts and tests each locked edge (locked_edges.h) in them. A cut refines a group
/// if its error exceeds the threshold times the distance to the eye. An edge locked at a level is tested in each cut
/// that has a triangle there of the surface of that level or the next coarser one. The number of triangles at the edge,
/// compared by position, must be equal to the number at the locked level. The worst value is the max number of cracks
/// in one cut.
Check checkCracks(const LoadedModel& model, std::uint64_t cuts, std::uint64_t seed, Progress& progress);

/// Runs the same check on a file and loads one cell of `cells` (from crackCells) at a time. `facts` are the facts of
/// the file. The result is identical, except that the text may describe another crack of a cut.
Check checkCracks(
    const hierarchy::ModelFile& file,
    const ModelFacts& facts,
    std::uint64_t cuts,
    std::uint64_t seed,
    std::span<const CrackCell> cells,
    Progress& progress);

/// Returns the memory in bytes that `cuts` cuts need in addition to the cells.
std::uint64_t cutBytes(std::uint64_t cuts);

} // namespace gnomon::verify
