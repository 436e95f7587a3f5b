// Random access to the vertices and faces of a PLY file. If all rows have fixed sizes, the size of the file gives their
// positions. Otherwise the file is read once to find the positions.
#pragma once

#include "core/progress.h"
#include "preprocess/read/ply/ply_rows.h"

#include <array>
#include <optional>

namespace gnomon::read {

/// Reads any range of vertices or faces of a PLY file whose triangles are all in one element. All functions except
/// indexRows and takeIndex are thread-safe.
class PlyRanges {
public:
    /// Creates a reader for the PLY elements with the indices `vertices` and `faces` in `header`. `file` and `header`
    /// must outlive this object.
    PlyRanges(const InputFile& file, const PlyHeader& header, std::size_t vertices, std::size_t faces);

    /// Finds the file positions of vertices and faces (see MeshSource::indexRows). Returns false if the file has a
    /// defect.
    bool indexRows(Progress& progress);

    /// Sets the file positions that another process found (see MeshSource::takeRowIndex).
    void takeIndex(const RowIndex::Part& index);

    /// Returns the file positions of vertices and faces. Throws Error if they are not known yet.
    const RowIndex::Part& index() const;

    /// Reads the vertices [begin, end) into `out` and then flushes `out`.
    void readVertices(std::uint64_t begin, std::uint64_t end, const VertexLayout& layout, VertexBuffer& out) const;

    /// Passes the triangles of the faces [begin, end) to `sink`. The result is that of MeshSource::readFaceRange.
    bool readFaces(std::uint64_t begin, std::uint64_t end, std::uint64_t vertexCount, const TriangleSink& sink) const;

private:
    /// An element of the PLY file and the layout of its rows.
    struct Rows {
        const PlyElement& element;
        int list = -1;           // for faces: index of the list property with the vertex indices
        std::uint64_t bytes = 0; // bytes per row; 0 if the rows have different sizes
    };

    Rows vertexRows() const;
    Rows faceRows() const;
    void findFixedRows();

    /// Reads the whole file and returns the file positions of its rows. Throws Error at the first defect.
    template <class Values>
    RowIndex::Part indexed(Values values, Progress& progress) const;

    /// Appends file positions of the rows of an element to `places`. `before` is the number of triangles in the rows
    /// before the element. Returns the number of triangles up to the end of the element.
    template <class Values>
    std::uint64_t indexElement(
        Values& values,
        const Rows& rows,
        std::uint64_t before,
        std::vector<RowIndex::Place>& places,
        Progress& progress) const;

    /// Skips the rows of `element` and returns the number of their triangles.
    template <class Values>
    std::uint64_t passOver(Values& values, const PlyElement& element, int list) const;

    /// Moves a reader of values to row `begin` of `range` = [begin, end) and calls `read(values, rows, firstTriangle)`.
    /// `rows` is an element with only the rows of `range`. `firstTriangle` is the number of triangles before them.
    template <class Read>
    void readRange(
        const Rows& rows,
        const std::vector<RowIndex::Place>& places,
        const std::array<std::uint64_t, 2>& range,
        Read read) const;

    const InputFile& file_;
    const PlyHeader& header_;
    std::size_t vertices_;
    std::size_t faces_;
    bool areTriangles_ = false; // whether the size of the file implies that all faces are triangles
    std::optional<RowIndex::Part> index_;
};

} // namespace gnomon::read
