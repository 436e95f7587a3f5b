// Builds several levels of detail for one part of the model (a node). The result depends only on the part, not on the
// number of threads.
#pragma once

#include "core/progress.h"
#include "preprocess/levels/open_clusters.h"
#include "preprocess/levels/page_layout.h"

namespace gnomon::levels {

/// The first level and the number of levels that are built for one part of the model.
struct NodePlan {
    std::uint32_t firstLevel = 0;
    std::uint32_t levelCount = 0; // max number of levels; kNone: up to the root
};

/// One finished level of detail of a part of the model.
struct NodeLevel {
    hierarchy::LevelInfo info;
    std::vector<hierarchy::EncodedPage> pages; // in page order; their offsets in the file are not set yet
};

/// The result of building a part of the model: its finished levels, and the clusters of its coarsest level. These
/// clusters have no groups yet.
struct BuiltNode {
    std::vector<NodeLevel> levels; // beginning with the first level of the plan
    EncodedOpenClusters pending;   // the clusters without groups; empty if the part was built up to its root
    std::uint64_t rootTriangles = 0;
    std::uint64_t irreducibleTriangles = 0; // triangles of level 0 that no coarser cluster replaces
};

/// Builds the levels of detail of `plan` from `level`, whose clusters have no groups yet. A plan up to the root ends if
/// one cluster is left or no further simplification succeeds. Any other plan ends after its last level, and `pending`
/// receives the clusters after this level. It ends earlier if a level cannot become coarser, because neighbours in a
/// later round may change this. Triangles of level 0 always receive groups.
BuiltNode buildNode(
    simplify::Mesh& mesh, Level level, const NodePlan& plan, const LevelOptions& options, Progress& progress);

} // namespace gnomon::levels
