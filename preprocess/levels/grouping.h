// Forms the groups of a level from neighbouring clusters. The clusters of a group are simplified together. A level
// defers some clusters and passes them on unchanged, because their simplification would cost far more error than the
// rest. All coarser levels would inherit this error. Deferred clusters are stored once, in the level that groups them.
#pragma once

#include "preprocess/levels/level.h"

namespace gnomon::levels {

/// An error with the number of triangles that have it.
struct WeightedError {
    double error = 0; // world units
    std::uint64_t triangles = 0;
};

/// Returns the smallest value of `errors` such that at least `share` (0 to 1) of the triangles do not exceed it.
/// Returns infinity for an empty list.
double errorQuantile(std::vector<WeightedError> errors, double share);

/// Forms the groups of `level`, which has the index `number`, and reorders its clusters and triangles by group. The
/// cuts differ from the previous level, so that locked borders become interior. If `mayDefer` is true, clusters with
/// more than twice the error of two thirds of the triangles are deferred. Each of them becomes a group after the
/// others. In this case all clusters must have a refinement.
void formGroups(
    Level& level, const hierarchy::Grid& grid, const LevelOptions& options, std::uint32_t number, bool mayDefer);

/// Removes the deferred groups from `level`.
void dropDeferred(Level& level);

/// Appends the clusters of the deferred groups of `level` to `next`, with their refinements.
void appendDeferred(const Level& level, Level& next);

} // namespace gnomon::levels
