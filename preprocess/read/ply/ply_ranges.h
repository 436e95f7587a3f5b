// Reading the rows of a PLY from anywhere: where they lie is told by the size of the file or found in one pass.
#pragma once

#include "core/progress.h"
#include "preprocess/read/ply/ply_rows.h"

#include <array>
#include <optional>

namespace gnomon::read {

/// Of a file whose triangles are all in one element. Safe from many threads at once but while it is indexed.
class PlyRanges {
public:
    /// Of the elements `vertices` and `faces` of the header. `file` and `header` must outlive it.
    PlyRanges(const InputFile& file, const PlyHeader& header, std::size_t vertices, std::size_t faces);

    /// As MeshSource::indexRows; false for nothing.
    bool indexRows(Progress& progress);

    /// As MeshSource::takeRowIndex.
    void takeIndex(const RowIndex::Part& index);

    /// Throws Error before rows are indexed.
    const RowIndex::Part& index() const;

    /// The vertices [begin, end).
    void readVertices(std::uint64_t begin, std::uint64_t end, const VertexLayout& layout, VertexBuffer& out) const;

    /// As MeshSource::readFaceRange.
    bool readFaces(std::uint64_t begin, std::uint64_t end, std::uint64_t vertexCount, const TriangleSink& sink) const;

private:
    /// An element.
    struct Rows {
        const PlyElement& element;
        int list = -1;           // of faces: the property with their corners
        std::uint64_t bytes = 0; // of each row, 0 where they differ
    };

    Rows vertexRows() const;
    Rows faceRows() const;
    void findFixedRows();

    /// Throws Error at a defect.
    template <class Values>
    RowIndex::Part indexed(Values values, Progress& progress) const;

    /// Where rows lie, behind `before` triangles; how many triangles are behind them.
    template <class Values>
    std::uint64_t indexElement(
        Values& values,
        const Rows& rows,
        std::uint64_t before,
        std::vector<RowIndex::Place>& places,
        Progress& progress) const;

    /// How many triangles were passed over.
    template <class Values>
    std::uint64_t passOver(Values& values, const PlyElement& element, int list) const;

    /// Calls `read` with values that stand at row `begin`, with an element of the rows [begin, end) alone and with the
    /// number of triangles before them.
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
    bool areTriangles_ = false; // all faces, as the size of the file tells
    std::optional<RowIndex::Part> index_;
};

} // namespace gnomon::read
