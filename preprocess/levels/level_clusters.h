// The clusters of a level: the first level of a mesh, and how clusters are entered into any.
#pragma once

#include "preprocess/levels/cluster.h"
#include "preprocess/levels/level.h"

#include <span>

namespace gnomon::levels {

/// Level 0: the mesh's triangles in clusters, without groups.
Level firstLevel(const simplify::Mesh& mesh, const LevelOptions& options);

/// Appends the clusters of `triangles`, which are in the order of `clustering`, to `level`; `firstTriangle` counts from
/// the first of them. Only the positions of the corners matter, which are vertices of `mesh`.
void appendClusters(
    const simplify::Mesh& mesh,
    std::span<const simplify::Triangle> triangles,
    const Clustering& clustering,
    Level& level);

} // namespace gnomon::levels
