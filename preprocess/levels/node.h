// A few levels of one part of the model at once: a pure function of the part, whatever threads share its groups.
#pragma once

#include "core/progress.h"
#include "preprocess/levels/page_layout.h"
#include "preprocess/levels/pending_level.h"

namespace gnomon::levels {

/// Which levels to build of a part.
struct NodePlan {
    std::uint32_t firstLevel = 0;
    std::uint32_t levelCount = 0; // at most; kNone: up to the root
};

/// What a part has of one level.
struct NodeLevel {
    hierarchy::LevelInfo info;
    std::vector<hierarchy::EncodedPage> pages; // in their order; none has its offset yet
};

struct BuiltNode {
    std::vector<NodeLevel> levels; // from the plan's first one on
    EncodedPendingLevel pending;   // empty after the root
    std::uint64_t rootTriangles = 0;
    std::uint64_t stuckTriangles = 0; // of level 0, never replaced
};

/// Builds the levels of `plan` from `level`, whose clusters are in no groups yet. Up to the root: until one cluster is
/// left or nothing gets coarser any more. Else what is left goes on: after the plan's last level, or before the one
/// that would not get coarser, since its neighbours may change that; but triangles of level 0 always get into groups.
BuiltNode buildNode(
    simplify::Mesh& mesh, Level level, const NodePlan& plan, const LevelOptions& options, Progress& progress);

} // namespace gnomon::levels
