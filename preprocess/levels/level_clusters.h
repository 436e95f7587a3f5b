// Divides the triangles of a level of detail into clusters.
#pragma once

#include "preprocess/levels/cluster.h"
#include "preprocess/levels/level.h"

#include <span>

namespace gnomon::levels {

/// Returns level 0 (full detail) of `mesh`. It contains all triangles in clusters, but no groups.
Level firstLevel(const simplify::Mesh& mesh, const LevelOptions& options);

/// Appends clusters of `triangles` to `level`. The triangles are sorted in the order of `clustering`. `firstTriangle`
/// of a new cluster counts from the first triangle of this call. The bounding boxes depend only on the corner
/// positions. The corners are vertices of `mesh`.
void appendClusters(
    const simplify::Mesh& mesh,
    std::span<const simplify::Triangle> triangles,
    const Clustering& clustering,
    Level& level);

} // namespace gnomon::levels
