// From one level to the next coarser one: every group simplified and cut into clusters again.
#pragma once

#include "core/progress.h"
#include "preprocess/levels/level.h"

namespace gnomon::levels {

/// Simplifies each group of `level` to half, as far as `limit` allows, sets the groups' errors, and returns the
/// clusters that replace them, not yet in groups, and after them those of deferred groups. Where little but locked
/// borders is left to collapse, a limit means to wait for the next level, whose borders lie elsewhere. Where the level
/// `mayDefer`, groups are deferred that add more error than four times the median of the level's groups, by their
/// triangles: other neighbours may help them, and by then the others cost as much. `next.refinements` begins with the
/// groups that are not deferred, in their order. Each group is simplified as a pure function of its own triangles and
/// of which positions it shares with others. Advances `progress` by the level's triangles.
Level simplifiedLevel(
    const simplify::Mesh& mesh,
    Level& level,
    const LevelOptions& options,
    simplify::CostLimit limit,
    bool mayDefer,
    Progress& progress);

} // namespace gnomon::levels
