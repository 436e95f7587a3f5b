// The fast paths for binary PLY bodies: vertices of fixed width column by column, triangle lists row by row in place.
#pragma once

#include "preprocess/read/ply/ply_rows.h"

namespace gnomon::read {

/// As readVertexRows, for an element without lists in a binary body.
void readVertexColumns(BinaryValues& values, const PlyElement& element, const VertexLayout& layout, VertexBuffer& out);

/// As readFaceRow for every row of the element. Fast where `list` is the only list and its indices are integers of
/// four bytes; whatever is no triangle of good indices goes through readFaceRow.
void readFaceRows(
    BinaryValues& values, const PlyElement& element, int list, std::uint64_t vertexCount, TriangleBuffer& out);

/// The vertices of an element, as fast as its layout allows.
inline void readVertexElement(
    BinaryValues& values, const PlyElement& element, const VertexLayout& layout, VertexBuffer& out) {
    if (element.hasLists()) return readVertexRows(values, element, layout, out);
    readVertexColumns(values, element, layout, out);
}

inline void readVertexElement(
    AsciiValues& values, const PlyElement& element, const VertexLayout& layout, VertexBuffer& out) {
    readVertexRows(values, element, layout, out);
}

/// Its faces likewise.
inline void readFaceElement(
    BinaryValues& values, const PlyElement& element, int list, std::uint64_t vertexCount, TriangleBuffer& out) {
    readFaceRows(values, element, list, vertexCount, out);
}

inline void readFaceElement(
    AsciiValues& values, const PlyElement& element, int list, std::uint64_t vertexCount, TriangleBuffer& out) {
    std::vector<std::uint64_t> corners;
    for (std::uint64_t row = 0; row < element.count; ++row)
        readFaceRow(values, element, list, vertexCount, out, corners);
}

/// The bytes of a row that is a triangle, where `list` is the only list of the element and is read fast; 0 elsewhere.
std::size_t triangleRowBytes(const PlyElement& element, int list);

} // namespace gnomon::read
