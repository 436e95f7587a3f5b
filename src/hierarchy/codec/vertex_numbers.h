// The stored numbers of the vertices of a page.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/codec/plane_kernel.h"
#include "hierarchy/codec/vertex_code.h"

#include <vector>

namespace gnomon::hierarchy {

/// The stored numbers of the vertices of a page, and the vertices that they belong to. Reuse this object from page to
/// page, because newly allocated memory costs a page fault per 4 KiB. All arrays except `referring` and `fresh` have
/// kMaxLanes additional elements.
struct VertexNumbers {
    // Per vertex: 0 for a new vertex. For a reference it is 1 + zigzag(distance from the successor of the last
    // referenced vertex).
    std::vector<std::uint32_t> references;
    std::vector<std::uint32_t> referring; // the vertices that are references, ascending
    std::vector<std::uint32_t> fresh;     // all other vertices, ascending; the following arrays refer to these
    std::vector<PositionWords> positions; // differences
    std::vector<std::uint64_t> normals;   // differences: joinedNormal modulo their width; empty without normals
    std::vector<std::uint32_t> colors;    // differences, one byte per channel; empty without colours
};

/// Reads the byte planes of one channel. Throws Damage if the bytes are invalid.
Planes takePlanes(ByteReader& in, std::size_t numbers);

/// Reads the stored numbers of `vertices` vertices, from the references on. Never allocates more than the bytes can
/// fill. Throws Damage if the bytes are invalid.
void takeVertexNumbers(ByteReader& in, std::size_t vertices, const AttributeLayout& layout, VertexNumbers& numbers);

} // namespace gnomon::hierarchy
