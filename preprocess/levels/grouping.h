// Forms groups of neighbouring clusters, which are simplified together. Clusters with much larger errors than the
// others are deferred: the next level contains them unchanged. Otherwise all coarser levels would inherit their errors.
// The model stores a deferred cluster once, in the level that groups it.
#pragma once

#include "preprocess/levels/level.h"

namespace gnomon::levels {

/// A simplification error and the number of triangles that have this error.
struct WeightedError {
    double error = 0; // world units
    std::uint64_t triangles = 0;
};

/// Returns the smallest error in `errors` that at least `share` (0 to 1) of the triangles do not exceed. Returns
/// infinity for an empty list.
double errorQuantile(std::vector<WeightedError> errors, double share);

/// Forms the groups of `level` from neighbouring clusters, and reorders its clusters and triangles by group. `number`
/// is the index of the level. The group borders differ from those of the previous level, so that locked borders become
/// interior. If `mayDefer` is true, clusters with large errors are deferred: the next level contains them unchanged.
/// These are the clusters with more than twice the error that two thirds of the triangles do not exceed. Each deferred
/// cluster becomes a group of its own, after the other groups. In this case all clusters must have a refinement.
void formGroups(
    Level& level, const hierarchy::Grid& grid, const LevelOptions& options, std::uint32_t number, bool mayDefer);

/// Removes from `level` the groups of deferred clusters, which the next level contains.
void dropDeferred(Level& level);

/// Appends the deferred clusters of `level` to the coarser level `next`, with their refinements (the finer groups from
/// which they were simplified).
void appendDeferred(const Level& level, Level& next);

} // namespace gnomon::levels
