// The survey of the visible geometry before shadow maps are planned: the depth ranges of surfaces that can be lit, and
// the positions of casters.
#pragma once

#include "core/depth_span.h"
#include "lod/cut.h"
#include "shadow/partition/region.h"

#include <vector>

namespace gnomon::lod {

/// Number of depth steps per octave. Depth spans consist of whole steps of this ratio. If all depths are within one
/// such step, for example in a distant view, even steps are used. Whole steps avoid a test of each triangle.
constexpr int kSpansPerOctave = 16;

/// The surfaces of an image that a light could reach.
struct LitSurfaces {
    /// Depth spans of drawn surfaces whose visible side faces the light, disjoint and in order. A span can extend one
    /// step beyond its surfaces, but never ends before them.
    std::vector<DepthSpan> spans;
    /// False if no such surface has a caster in front of it. True is not certain.
    bool canBeShadowed = false;
};

/// Returns the surfaces of `image` that are lit from `towardsLight` (unit, local space) unless a caster within
/// `casters` (local space) shadows them. Depths below `depths.near` (above 0, world units) count as `depths.near`, and
/// depths above `depths.far` count as `depths.far`.
LitSurfaces litSurfaces(
    const lod::CutQuery& query,
    const lod::DrawList& image,
    const glm::dvec3& towardsLight,
    const Box& casters,
    const DepthSpan& depths);

/// Returns the visible slabs of `image`, one per depth step. The steps are the same as for depth spans. A slab contains
/// whole clusters that intersect the view pyramid, extended by the error of any refinement. Boxes are in the model's
/// axes, relative to the eye.
std::vector<shadow::VisibleSlab> visibleSlabs(
    const lod::CutQuery& query, const lod::DrawList& image, const DepthSpan& depths);

/// Adjacent clusters of a draw list.
struct CasterBlock {
    Box box; // local space, extended by the error of any refinement
    std::uint64_t triangles = 0;
};

/// Returns the clusters of `list` in blocks of at most kClustersPerBlock, in list order.
std::vector<CasterBlock> casterBlocks(const lod::CutQuery& query, const lod::DrawList& list);

constexpr std::uint32_t kClustersPerBlock = 16;

} // namespace gnomon::lod
