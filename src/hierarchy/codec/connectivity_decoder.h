// The decoder of the triangles of a page's clusters.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/page.h"

#include <span>

namespace gnomon::hierarchy {

/// Marks a vertex that was not new across an open edge. Other vertices of a page have a word for the open edge across
/// which they were new. The word contains the vertex indices `from`, `to` and the opposite corner, one byte each, low
/// byte first.
constexpr std::uint32_t kNoEdge = 0xFFFFFFU;
using EdgeWords = std::vector<std::uint32_t>;

/// Decodes `page.triangles` from `codes`, one code byte per triangle, and from the second stream `indices`. The
/// function may read one byte after the end of `indices`. `edges` receives one word per vertex, and kMaxLanes
/// additional words. Throws Damage if the codes are invalid.
void decodeConnectivity(
    std::span<const std::byte> codes, std::span<const std::byte> indices, Page& page, EdgeWords& edges);

} // namespace gnomon::hierarchy
