// Creates the next coarser level: simplifies each group and divides the result into clusters.
#pragma once

#include "core/progress.h"
#include "preprocess/levels/level.h"

namespace gnomon::levels {

/// Simplifies each group of `level` to half of its triangles, as far as `limit` permits, and sets the errors of the
/// groups. Returns the new clusters without groups, followed by the clusters of deferred groups. With a limit, a group
/// with mostly locked borders remains for the next level, where its borders are elsewhere.
///
/// If `mayDefer` is true, a group is deferred if it adds more than four times the median error of the level, weighted
/// by triangles. Other neighbours may reduce this error in a later level. `next.refinements` begins with the groups
/// that are not deferred, in order. The result for a group is a pure function of its triangles and its shared
/// positions. Advances `progress` by the triangles of the level.
Level simplifiedLevel(
    const simplify::Mesh& mesh,
    Level& level,
    const LevelOptions& options,
    simplify::CostLimit limit,
    bool mayDefer,
    Progress& progress);

} // namespace gnomon::levels
