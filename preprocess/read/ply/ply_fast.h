// Fast readers for binary PLY bodies. They read vertices of fixed size column by column, and triangles row by row.
#pragma once

#include "preprocess/read/ply/ply_rows.h"

namespace gnomon::read {

/// Reads the vertices of an element without lists from a binary body. The result is equal to that of readVertexRows.
void readVertexColumns(BinaryValues& values, const PlyElement& element, const VertexLayout& layout, VertexBuffer& out);

/// Reads all rows of a face element. The result is equal to calling readFaceRow for each row. The fast path requires
/// that `list` is the only list and that its indices are integers of four bytes. readFaceRow reads the rows that are
/// not triangles with valid indices.
void readFaceRows(
    BinaryValues& values, const PlyElement& element, int list, std::uint64_t vertexCount, TriangleBuffer& out);

/// Reads the vertices of an element with the fastest reader for its layout.
inline void readVertexElement(
    BinaryValues& values, const PlyElement& element, const VertexLayout& layout, VertexBuffer& out) {
    if (element.hasLists()) return readVertexRows(values, element, layout, out);
    readVertexColumns(values, element, layout, out);
}

inline void readVertexElement(
    AsciiValues& values, const PlyElement& element, const VertexLayout& layout, VertexBuffer& out) {
    readVertexRows(values, element, layout, out);
}

/// Reads the faces of an element with the fastest reader for its body.
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

/// Returns the size in bytes of a row that is a triangle. Returns 0 if the fast path cannot read the element (see
/// readFaceRows).
std::size_t triangleRowBytes(const PlyElement& element, int list);

} // namespace gnomon::read
