// Forming the groups of a level: neighbouring clusters, to be simplified together. Some clusters are deferred: a level
// passes them on as they are, since to replace them now would cost far more error than the rest of it does, and that
// error would stand in all that is ever built on top. They are stored once, with the level that groups them.
#pragma once

#include "preprocess/levels/level.h"

namespace gnomon::levels {

/// An error, and the triangles that have it.
struct WeightedError {
    double error = 0; // world units
    std::uint64_t triangles = 0;
};

/// The least of `errors` that is not below those of at least `share` (0 to 1) of the triangles; infinity for none.
double errorQuantile(std::vector<WeightedError> errors, double share);

/// Forms the groups of `level`, the `number`th from 0, and reorders clusters and triangles accordingly. Cuts lie
/// elsewhere than in the level before, so that the borders which were locked there become interiors here. Where it
/// `mayDefer` (then all clusters refine into something), clusters of more than twice the error of two thirds of the
/// triangles are groups by themselves, after the others, and deferred.
void formGroups(
    Level& level, const hierarchy::Grid& grid, const LevelOptions& options, std::uint32_t number, bool mayDefer);

/// Leaves out of `level` the groups that are deferred.
void dropDeferred(Level& level);

/// Appends the clusters of the groups of `level` that are deferred to `next`, with what they refine into.
void appendDeferred(const Level& level, Level& next);

} // namespace gnomon::levels
