// Reads the stored numbers from which the vertices of a page are decoded.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/codec/plane_kernel.h"
#include "hierarchy/codec/vertex_code.h"

#include <vector>

namespace gnomon::hierarchy {

/// The stored numbers of the vertices of a page, sorted by vertex. Reuse this object for many pages, because newly
/// allocated memory costs a page fault per 4 KiB. All arrays except `referring` and `fresh` have kMaxLanes additional
/// elements.
struct VertexNumbers {
    // One number per vertex. It is 0 for a new vertex. If the vertex refers to an earlier one, it is 1 + zigzag(d),
    // where d is the distance from the vertex after the last referenced one.
    std::vector<std::uint32_t> references;
    std::vector<std::uint32_t> referring; // indices of the vertices that are references, ascending
    // Indices of all vertices that do not refer to earlier ones, ascending. The following arrays have one entry for
    // each of them.
    std::vector<std::uint32_t> fresh;
    std::vector<PositionWords> positions; // differences
    std::vector<std::uint64_t> normals;   // differences of joined normals, modulo their width; empty without normals
    std::vector<std::uint32_t> colors;    // differences, one byte per channel; empty without colours
};

/// Reads the byte planes of one channel of `numbers` numbers. Throws Damage if there are not enough bytes.
Planes takePlanes(ByteReader& in, std::size_t numbers);

/// Reads the stored numbers of `vertices` vertices. The references to earlier vertices come first. The number of
/// available bytes limits the allocated memory. Throws Damage if the bytes are invalid.
void takeVertexNumbers(ByteReader& in, std::size_t vertices, const AttributeLayout& layout, VertexNumbers& numbers);

} // namespace gnomon::hierarchy
