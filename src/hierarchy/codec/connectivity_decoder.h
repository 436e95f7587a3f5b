// Decodes the triangles of a page's clusters.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/page.h"

#include <span>

namespace gnomon::hierarchy {

/// The edge word of a vertex that no edge predicts. The edge word of any other vertex contains the vertex indices of
/// the edge across which the vertex was new: `from`, `to` and the opposite corner, one byte each, low byte first.
constexpr std::uint32_t kNoEdge = 0xFFFFFFU;
using EdgeWords = std::vector<std::uint32_t>;

/// Decodes the triangles of `page` from `codes`, one code byte per triangle, and from the second stream `indices`. The
/// function may read one byte after the end of `indices`. `edges` receives one edge word per vertex, and kMaxLanes
/// additional words. Throws Damage if the codes are invalid.
void decodeConnectivity(
    std::span<const std::byte> codes, std::span<const std::byte> indices, Page& page, EdgeWords& edges);

} // namespace gnomon::hierarchy
