// Surveys the visible geometry before shadow maps are planned: the depth ranges of surfaces that can be lit, and the
// positions of casters.
#pragma once

#include "core/depth_span.h"
#include "lod/cut.h"
#include "shadow/partition/region.h"

#include <vector>

namespace gnomon::lod {

/// Number of depth steps per factor 2 in view depth. Depth spans consist of whole steps, so not every triangle must be
/// tested. If all depths are within one such step, for example in a distant view, the range is divided into steps of
/// equal size.
constexpr int kSpansPerOctave = 16;

/// The visible surfaces of an image whose visible side faces the light.
struct LitSurfaces {
    /// View depths of these surfaces, as disjoint and sorted spans. A span can extend one step beyond its surfaces, but
    /// is never shorter.
    std::vector<DepthSpan> spans;
    /// False: certainly no caster is between the light and these surfaces. True: a caster may be.
    bool canBeShadowed = false;
};

/// Returns the surfaces of `image` whose visible side faces `towardsLight` (unit, local space). `casters` is the box of
/// all casters (local space). Depths below `depths.near` (above 0, world units) are clamped to `depths.near`, and
/// depths above `depths.far` to `depths.far`.
LitSurfaces litSurfaces(
    const lod::CutQuery& query,
    const lod::DrawList& image,
    const glm::dvec3& towardsLight,
    const Box& casters,
    const DepthSpan& depths);

/// Returns the boxes of the visible surfaces of `image`, one box (slab) per step of view depth. The steps are the same
/// as for LitSurfaces::spans. A slab contains all clusters at its depths that intersect the view pyramid, as whole
/// clusters. It is extended by the stored error of their refinements. Boxes are in the model's axes, relative to the
/// eye.
std::vector<shadow::VisibleSlab> visibleSlabs(
    const lod::CutQuery& query, const lod::DrawList& image, const DepthSpan& depths);

/// A block of adjacent clusters of a list of drawn casters.
struct CasterBlock {
    Box box; // local space, extended by the stored errors of the refinements
    std::uint64_t triangles = 0;
};

/// Divides the drawn clusters in `list`, in their order, into blocks of at most kClustersPerBlock clusters.
std::vector<CasterBlock> casterBlocks(const lod::CutQuery& query, const lod::DrawList& list);

constexpr std::uint32_t kClustersPerBlock = 16;

} // namespace gnomon::lod
