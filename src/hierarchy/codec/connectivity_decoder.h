// The decoder of the triangles of a page's clusters.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/page.h"

#include <span>

namespace gnomon::hierarchy {

/// Per vertex of a page, the open edge across which the vertex was new. A word contains from, to and the opposite
/// corner, one byte each, low byte first. The word is kNoEdge if there was no such edge.
constexpr std::uint32_t kNoEdge = 0xFFFFFFU;
using EdgeWords = std::vector<std::uint32_t>;

/// Decodes `page.triangles` from one code byte per triangle and the stream of `indices`. One byte after the end of
/// `indices` may be read. `edges` receives one word per vertex, and kMaxLanes additional words. Throws Damage if the
/// codes are invalid.
void decodeConnectivity(
    std::span<const std::byte> codes, std::span<const std::byte> indices, Page& page, EdgeWords& edges);

} // namespace gnomon::hierarchy
