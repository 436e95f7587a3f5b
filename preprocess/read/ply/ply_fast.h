// Fast readers for the bodies of binary PLY files. They decode vertices of fixed size attribute by attribute, and
// triangles row by row.
#pragma once

#include "preprocess/read/ply/ply_rows.h"

namespace gnomon::read {

/// Reads the vertices of a binary PLY element without list properties. The result is equal to that of readVertexRows.
void readVertexColumns(BinaryValues& values, const PlyElement& element, const VertexLayout& layout, VertexBuffer& out);

/// Reads all faces of a PLY element. The result is equal to that of readFaceRow for each face. The fast path reads only
/// triangles with valid indices, and leaves other faces to readFaceRow. It requires that `list` is the only list
/// property and that its indices are integers of four bytes.
void readFaceRows(
    BinaryValues& values, const PlyElement& element, int list, std::uint64_t vertexCount, TriangleBuffer& out);

/// Reads the vertices of a PLY element with the fastest reader for the layout of its rows.
inline void readVertexElement(
    BinaryValues& values, const PlyElement& element, const VertexLayout& layout, VertexBuffer& out) {
    if (element.hasLists()) return readVertexRows(values, element, layout, out);
    readVertexColumns(values, element, layout, out);
}

inline void readVertexElement(
    AsciiValues& values, const PlyElement& element, const VertexLayout& layout, VertexBuffer& out) {
    readVertexRows(values, element, layout, out);
}

/// Reads the faces of a PLY element with the fastest reader for a binary or an ASCII file.
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

/// Returns the number of bytes that a triangle uses in the element's rows. Returns 0 if the fast path cannot read the
/// element (see readFaceRows).
std::size_t triangleRowBytes(const PlyElement& element, int list);

} // namespace gnomon::read
