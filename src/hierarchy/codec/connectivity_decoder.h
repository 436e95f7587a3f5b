// Reads the triangles of a page's clusters.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/page.h"

#include <span>

namespace gnomon::hierarchy {

/// By vertex of a page, the open edge across which it was new: from, to and the opposite corner, a byte each, low ones
/// first; kNoEdge if there was none.
constexpr std::uint32_t kNoEdge = 0xFFFFFFU;
using EdgeWords = std::vector<std::uint32_t>;

/// Fills `page.triangles` from a code byte each and the stream of `indices`, behind which one byte may be looked at.
/// `edges` gets one word a vertex, and kMostLanes more. Throws Damage.
void decodeConnectivity(
    std::span<const std::byte> codes, std::span<const std::byte> indices, Page& page, EdgeWords& edges);

} // namespace gnomon::hierarchy
