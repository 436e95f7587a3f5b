// Builds several levels of one part of the model. The result is a pure function of the part and does not depend on the
// threads.
#pragma once

#include "core/progress.h"
#include "preprocess/levels/open_clusters.h"
#include "preprocess/levels/page_layout.h"

namespace gnomon::levels {

/// The levels to build of a part.
struct NodePlan {
    std::uint32_t firstLevel = 0;
    std::uint32_t levelCount = 0; // max number of levels; kNone: up to the root
};

/// The data of one level of a part.
struct NodeLevel {
    hierarchy::LevelInfo info;
    std::vector<hierarchy::EncodedPage> pages; // in page order; without file offsets
};

/// The result of a node: its finished levels and its clusters without groups.
struct BuiltNode {
    std::vector<NodeLevel> levels; // from the first level of the plan on
    EncodedOpenClusters pending;   // empty after the root
    std::uint64_t rootTriangles = 0;
    std::uint64_t irreducibleTriangles = 0; // triangles of level 0 that no coarser cluster replaces
};

/// Builds the levels of `plan` from `level`, whose clusters have no groups yet. Up to the root means: until one cluster
/// is left or no further simplification succeeds. Otherwise `pending` receives the clusters after the last level of the
/// plan. It receives them earlier if a level cannot become coarser, because neighbours may change this. Triangles of
/// level 0 always get groups.
BuiltNode buildNode(
    simplify::Mesh& mesh, Level level, const NodePlan& plan, const LevelOptions& options, Progress& progress);

} // namespace gnomon::levels
