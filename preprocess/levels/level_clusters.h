// Creates the clusters of a level.
#pragma once

#include "preprocess/levels/cluster.h"
#include "preprocess/levels/level.h"

#include <span>

namespace gnomon::levels {

/// Returns level 0 of `mesh`. It contains all triangles in clusters, without groups.
Level firstLevel(const simplify::Mesh& mesh, const LevelOptions& options);

/// Appends the clusters of `triangles` to `level`. The triangles are sorted in the order of `clustering`. The clusters'
/// `firstTriangle` counts from the first triangle of this call. The boxes depend only on the positions of the corners,
/// which are vertices of `mesh`.
void appendClusters(
    const simplify::Mesh& mesh,
    std::span<const simplify::Triangle> triangles,
    const Clustering& clustering,
    Level& level);

} // namespace gnomon::levels
