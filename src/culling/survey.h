// What a plan wants to know of the geometry before it says which shadow maps a view calls for: where in depth the
// surfaces lie that the light could reach, and where the casters are.
#pragma once

#include "core/depth_span.h"
#include "selection/cut.h"
#include "shadow/partition/region.h"

#include <vector>

namespace gnomon::culling {

/// Depth spans are whole steps of this ratio, or as many even ones where all lies within one of these, as from far
/// away: the price of not looking at every triangle.
constexpr int kSpansPerOctave = 16;

/// What of an image a light could reach.
struct LitSurfaces {
    /// Depths of drawn surfaces whose seen side faces the light; apart and in order. A span may reach further than its
    /// surfaces by one step, never less far.
    std::vector<DepthSpan> spans;
    /// Whether any of them has a caster in front of it; only sure where it says no.
    bool canBeShadowed = false;
};

/// The parts of `image` that are lit from `towardsLight` (unit, local space) unless something of `casters` (local
/// space) shadows them; depths under `least` (above 0, world units) count as `least`, those over `greatest` likewise.
LitSurfaces litSurfaces(
    const selection::CutQuery& query,
    const selection::DrawList& image,
    const glm::dvec3& towardsLight,
    const Box& casters,
    const DepthSpan& depths);

/// All that `image` shows, step by step of depth, the steps as for spans: whole clusters that reach into the view's
/// pyramid, with what any refinement may move them by. Boxes are in the model's axes, relative to the eye.
std::vector<shadow::SeenPart> seenParts(
    const selection::CutQuery& query, const selection::DrawList& image, const DepthSpan& depths);

/// Neighbouring clusters of a draw list.
struct CasterBlock {
    Box box; // local space, with what any refinement may move them by
    std::uint64_t triangles = 0;
};

/// The clusters of `list` in blocks of at most kClustersPerBlock, in the list's order.
std::vector<CasterBlock> casterBlocks(const selection::CutQuery& query, const selection::DrawList& list);

constexpr std::uint32_t kClustersPerBlock = 16;

} // namespace gnomon::culling
