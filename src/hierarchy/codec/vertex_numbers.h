// What a file stores of the vertices of a page, as numbers.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/codec/plane_kernel.h"
#include "hierarchy/codec/vertex_code.h"

#include <vector>

namespace gnomon::hierarchy {

/// What is stored of the vertices of a page, and which vertices it is of. To be kept from page to page: memory given
/// back to the system is paid for again, a page fault every four KiB. All but `referring` have kMostLanes too many.
struct VertexNumbers {
    std::vector<std::uint32_t> references; // by vertex: 0, or 1 + the zigzag of how far from the one after the last
    std::vector<std::uint32_t> referring;  // the vertices that are references, ascending
    std::vector<std::uint32_t> fresh;      // the others, ascending; the following are of these
    std::vector<PositionWords> positions;  // differences
    std::vector<std::uint64_t> normals;    // differences, joinedNormal modulo their width; nothing if there are none
    std::vector<std::uint32_t> colors;     // differences, a byte each; nothing if there are none
};

/// One channel of numbers of vertices. Throws Damage.
Planes takePlanes(ByteReader& in, std::size_t numbers);

/// Takes what is stored of `vertices` vertices, but for what stands before the references. Nothing is allocated that
/// the bytes cannot fill. Throws Damage.
void takeVertexNumbers(ByteReader& in, std::size_t vertices, const AttributeLayout& layout, VertexNumbers& numbers);

} // namespace gnomon::hierarchy
