// Forming the groups of a level: neighbouring clusters, to be simplified together.
#pragma once

#include "preprocess/levels/level.h"

namespace gnomon::levels {

/// Forms the groups of `level`, the `number`th from 0, and reorders clusters and triangles accordingly. Cuts lie
/// elsewhere than in the level before, so that the borders which were locked there become interiors here.
void formGroups(Level& level, const hierarchy::Grid& grid, const LevelOptions& options, std::uint32_t number);

} // namespace gnomon::levels
