// Finds the drawn triangles of an image that are inside a volume, and the range of their view depths.
#pragma once

#include "core/depth_span.h"
#include "lod/cut.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::lod {

/// The range of view depths of all drawn geometry inside the view pyramid.
struct VisibleDepths {
    DepthSpan span;                     // near is 0 if drawn geometry crosses the plane through the eye
    std::uint64_t clustersMeasured = 0; // clusters whose triangles were tested one by one
};

/// A drawn cluster whose triangles may have the min or max view depth, and the range of view depths of its box.
struct DepthCandidate {
    double minDepth = 0;
    double maxDepth = 0;
    std::uint32_t page = 0;
    std::uint32_t cluster = 0;
    double margin = 0; // stored error of the refinement, if the refinement is missing
};

/// Returns the range of view depths of the drawn clusters in `image`, a list of `query`. The function uses the boxes of
/// clusters. For clusters whose box contains the min or the max, it uses the exact triangles. If a finer page is
/// missing, the stored error of its clusters widens the range. Returns nullopt if no geometry is visible. The function
/// overwrites `scratch`; reuse it between frames to avoid allocations.
std::optional<VisibleDepths> visibleDepthRange(
    const lod::CutQuery& query, const lod::DrawList& image, std::vector<DepthCandidate>& scratch);

/// Returns the range of view depths of the drawn clusters in `image`, as the function above, with temporary buffers.
std::optional<VisibleDepths> visibleDepthRange(const lod::CutQuery& query, const lod::DrawList& image);

/// Returns, for each element of `volumes` (local space), whether a triangle of `image` has a point that is inside both
/// the volume and the view pyramid.
std::vector<bool> receivingVolumes(
    const lod::CutQuery& query, const lod::DrawList& image, std::span<const ConvexVolume> volumes);

} // namespace gnomon::lod
