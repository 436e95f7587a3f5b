// Creates the next coarser level of detail. It simplifies each group and divides the result into clusters.
#pragma once

#include "core/progress.h"
#include "preprocess/levels/level.h"

namespace gnomon::levels {

/// Simplifies each group of `level` to half of its triangles, as far as the error limit `limit` permits, and sets the
/// errors of the groups. Returns the next level without groups: the new clusters, followed by the clusters of deferred
/// groups. A group with mostly locked borders may not reach its target within `limit`. Its clusters then remain for the
/// next level, where the group borders differ.
/// If `mayDefer` is true, a group is deferred if its added error exceeds four times the median of the level, weighted
/// by triangles. Other neighbours may reduce this error in a later level. The refinements of the result begin with the
/// groups that are not deferred, in order. The result for a group depends only on its triangles and its shared
/// positions. The function advances `progress` by the number of triangles of the level.
Level simplifiedLevel(
    const simplify::Mesh& mesh,
    Level& level,
    const LevelOptions& options,
    simplify::CostLimit limit,
    bool mayDefer,
    Progress& progress);

} // namespace gnomon::levels
