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

/// The bytes of a row that is a triangle, where `list` is the only list of the element and is read fast; 0 elsewhere.
std::size_t triangleRowBytes(const PlyElement& element, int list);

/// As readFaceRows where all rows are triangles of good indices and `triangleRowBytes` is not 0; false at the first
/// that is none, with those before it in `out`.
bool readTriangleRows(
    BinaryValues& values, const PlyElement& element, int list, std::uint64_t vertexCount, TriangleBuffer& out);

} // namespace gnomon::read
