// The fast paths for binary PLY bodies: vertices of fixed width column by column, triangle lists row by row in place.
#pragma once

#include "preprocess/read/ply_rows.h"

namespace gnomon::read {

/// As readVertexRows, for an element without lists in a binary body.
void readVertexColumns(BinaryValues& values, const PlyElement& element, const VertexLayout& layout, VertexBuffer& out);

/// As readFaceRow for every row of the element. Fast where `list` is the only list and its indices are integers of
/// four bytes; whatever is no triangle of good indices goes through readFaceRow.
void readFaceRows(
    BinaryValues& values, const PlyElement& element, int list, std::uint64_t vertexCount, TriangleBuffer& out);

} // namespace gnomon::read
