// The receivers: what of the image's draw list lies in a volume, to the triangle, and between which depths.
#pragma once

#include "core/depth_span.h"
#include "selection/cut.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::culling {

/// The least and the greatest view depth of anything drawn inside the view's pyramid.
struct VisibleDepths {
    DepthSpan span;                     // near is 0 if something drawn passes the eye's plane
    std::uint64_t clustersMeasured = 0; // how many had to be looked at triangle by triangle
};

/// A drawn cluster and the view depths that its box spans.
struct DepthCandidate {
    double least = 0;
    double greatest = 0;
    std::uint32_t page = 0;
    std::uint32_t cluster = 0;
    double margin = 0; // the stored error of a refinement that is missing
};

/// The depth range of `image`, a draw list of `query`: from boxes, exact on the clusters whose box crosses the minimum
/// or the maximum, and widened by the stored error where a refinement is missing. Nothing if nothing is seen. `scratch`
/// is overwritten, and is memory to be kept from frame to frame.
std::optional<VisibleDepths> visibleDepthRange(
    const selection::CutQuery& query, const selection::DrawList& image, std::vector<DepthCandidate>& scratch);

/// The same once.
std::optional<VisibleDepths> visibleDepthRange(const selection::CutQuery& query, const selection::DrawList& image);

/// For each of `volumes` (local space) whether any triangle of `image` has a point in both it and the view's pyramid.
std::vector<bool> receivingVolumes(
    const selection::CutQuery& query, const selection::DrawList& image, std::span<const ConvexVolume> volumes);

} // namespace gnomon::culling
