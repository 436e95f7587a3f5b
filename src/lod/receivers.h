// The receivers: triangles of the image's draw list inside a volume, and their depth range.
#pragma once

#include "core/depth_span.h"
#include "lod/cut.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::lod {

/// The view depths of all drawn geometry inside the view pyramid.
struct VisibleDepths {
    DepthSpan span;                     // near is 0 if drawn geometry crosses the plane through the eye
    std::uint64_t clustersMeasured = 0; // clusters whose triangles were tested one by one
};

/// A drawn cluster and the view depths of its box.
struct DepthCandidate {
    double minDepth = 0;
    double maxDepth = 0;
    std::uint32_t page = 0;
    std::uint32_t cluster = 0;
    double margin = 0; // stored error of a missing refinement
};

/// Returns the depth range of `image`, a draw list of `query`. It uses boxes, and exact triangles for clusters whose
/// box contains the min or the max. The stored error widens the range where a refinement is missing. Returns nothing if
/// nothing is visible. `scratch` is overwritten; reuse it between frames to save allocations.
std::optional<VisibleDepths> visibleDepthRange(
    const lod::CutQuery& query, const lod::DrawList& image, std::vector<DepthCandidate>& scratch);

/// Returns the same range with a temporary `scratch`.
std::optional<VisibleDepths> visibleDepthRange(const lod::CutQuery& query, const lod::DrawList& image);

/// Returns for each of `volumes` (local space) whether a triangle of `image` has a point inside both the volume and the
/// view pyramid.
std::vector<bool> receivingVolumes(
    const lod::CutQuery& query, const lod::DrawList& image, std::span<const ConvexVolume> volumes);

} // namespace gnomon::lod
