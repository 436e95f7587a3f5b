// Searches for cracks in random view-dependent cuts. A crack is an edge on a border between groups that does not have
// the right number of triangles.
#pragma once

#include "preprocess/verify/check.h"
#include "preprocess/verify/crack_cells.h"
#include "preprocess/verify/loaded_model.h"
#include "preprocess/verify/model_facts.h"

namespace gnomon::verify {

/// Draws `cuts` random view-dependent cuts of `model` and searches for cracks at the locked edges (borders between
/// groups, see locked_edges.h). A cut refines a group if the group's error exceeds a threshold times the distance to
/// the eye.
///
/// An edge that is locked at a level is tested in a cut if one of the cut's triangles there belongs to the surface of
/// this level or of the next coarser level. The number of the cut's triangles at the edge must then be equal to the
/// number in the locked level. Edges are compared by position. The worst value of the result is the max number of
/// cracks in one cut.
Check checkCracks(const LoadedModel& model, std::uint64_t cuts, std::uint64_t seed, Progress& progress);

/// Searches for cracks like the other checkCracks, but reads the model from `file` and loads only one cell of `cells`
/// (from crackCells) at a time. `facts` are the ModelFacts of the file. The result is identical, except that its text
/// may describe another crack of the same cut.
Check checkCracks(
    const hierarchy::ModelFile& file,
    const ModelFacts& facts,
    std::uint64_t cuts,
    std::uint64_t seed,
    std::span<const CrackCell> cells,
    Progress& progress);

/// Returns the memory in bytes that checkCracks needs for `cuts` cuts, in addition to the memory for the cells.
std::uint64_t cutBytes(std::uint64_t cuts);

} // namespace gnomon::verify
