#include "preprocess/read/ply/ply_ranges.h"

#include "preprocess/read/ply/ply_fast.h"
#include "preprocess/read/ply/ply_layout.h"

#include <algorithm>

namespace gnomon::read {

PlyRanges::PlyRanges(const InputFile& file, const PlyHeader& header, std::size_t vertices, std::size_t faces)
    : file_(file), header_(header), vertices_(vertices), faces_(faces) {
    findFixedRows();
}

// Sets the file positions of rows if all rows have fixed sizes and the size of the file is equal to their total size.
// All faces are then triangles.
void PlyRanges::findFixedRows() {
    if (header_.format == PlyFormat::Ascii) return;
    RowIndex::Part index;
    std::uint64_t offset = header_.bodyOffset;
    for (std::size_t i = 0; i < header_.elements.size(); ++i) {
        const PlyElement& element = header_.elements[i];
        std::uint64_t rowBytes = element.minRowBytes(header_.format);
        if (i == faces_)
            rowBytes = triangleRowBytes(element, indexListOf(element));
        else if (element.hasLists())
            rowBytes = 0;
        if (rowBytes == 0 || element.count > (file_.size() - offset) / rowBytes) return;
        if (i == vertices_) index.vertices.push_back({offset, 0, 0});
        if (i == faces_) index.faces.push_back({offset, 0, 0});
        offset += rowBytes * element.count;
    }
    if (offset != file_.size()) return;
    areTriangles_ = true;
    index.triangles = header_.elements[faces_].count;
    index_ = std::move(index);
}

PlyRanges::Rows PlyRanges::vertexRows() const {
    const PlyElement& element = header_.elements[vertices_];
    const bool isFixed = header_.format != PlyFormat::Ascii && !element.hasLists();
    return {element, -1, isFixed ? element.minRowBytes(header_.format) : 0};
}

PlyRanges::Rows PlyRanges::faceRows() const {
    const PlyElement& element = header_.elements[faces_];
    const int list = indexListOf(element);
    return {element, list, areTriangles_ ? triangleRowBytes(element, list) : 0};
}

bool PlyRanges::indexRows(Progress& progress) {
    if (index_) return true;
    progress.stage("index", "rows", header_.elements[vertices_].count + header_.elements[faces_].count);
    const PlyPlace body{header_.bodyOffset, header_.bodyLine};
    try {
        index_ = header_.format == PlyFormat::Ascii ? indexed(AsciiValues(file_, header_.lineEnd, body), progress)
                                                    : indexed(BinaryValues(file_, header_.format, body), progress);
    } catch (const Error&) {
        return false;
    }
    return true;
}

template <class Values>
RowIndex::Part PlyRanges::indexed(Values values, Progress& progress) const {
    RowIndex::Part index;
    for (std::size_t i = 0; i < header_.elements.size(); ++i) {
        if (i == vertices_)
            indexElement(values, vertexRows(), 0, index.vertices, progress);
        else if (i == faces_)
            index.triangles = indexElement(values, faceRows(), 0, index.faces, progress);
        else
            skipElement(values, header_.elements[i], header_.format);
    }
    values.expectEnd();
    return index;
}

template <class Values>
std::uint64_t PlyRanges::indexElement(
    Values& values, const Rows& rows, std::uint64_t before, std::vector<RowIndex::Place>& places, Progress& progress)
    const {
    PlyElement some = rows.element;
    for (std::uint64_t row = 0; row < rows.element.count; row += some.count) {
        const PlyPlace place = values.place();
        places.push_back({place.offset, place.line, before});
        some.count = rows.element.count - row;
        if (rows.bytes == 0) some.count = std::min(some.count, RowIndex::kRows);
        before += passOver(values, some, rows.list);
        progress.advance(some.count);
    }
    return before;
}

template <class Values>
std::uint64_t PlyRanges::passOver(Values& values, const PlyElement& element, int list) const {
    if (list >= 0) return skipFaces(values, element, static_cast<std::size_t>(list));
    skipElement(values, element, header_.format);
    return 0;
}

void PlyRanges::takeIndex(const RowIndex::Part& index) {
    const auto isOf = [&](const std::vector<RowIndex::Place>& places, const Rows& rows) {
        const std::uint64_t strides = (rows.element.count + RowIndex::kRows - 1) / RowIndex::kRows;
        // The subtraction cannot underflow, because the row counts were already checked against the size of the file.
        const std::uint64_t last = file_.size() - rows.bytes * rows.element.count;
        return places.size() == (rows.bytes > 0 ? std::min<std::uint64_t>(strides, 1) : strides) &&
               std::ranges::all_of(places, [&](const RowIndex::Place& place) { return place.offset <= last; });
    };
    if (!isOf(index.vertices, vertexRows()) || !isOf(index.faces, faceRows()))
        throw Error(file_.path(), "another process read a different file; all processes must read the same file");
    index_ = index;
}

const RowIndex::Part& PlyRanges::index() const {
    if (!index_) throw Error(file_.path(), "the rows have no index yet, so they can only be read in order");
    return *index_;
}

template <class Read>
void PlyRanges::readRange(
    const Rows& rows,
    const std::vector<RowIndex::Place>& places,
    const std::array<std::uint64_t, 2>& range,
    Read read) const {
    const std::uint64_t begin = range[0];
    const std::uint64_t end = range[1];
    if (begin >= end) return;
    const bool isFixed = rows.bytes > 0;
    const RowIndex::Place& near = places.at(isFixed ? 0 : begin / RowIndex::kRows);
    const auto from = [&](auto values) {
        PlyElement some = rows.element;
        some.count = isFixed ? 0 : begin % RowIndex::kRows;
        const std::uint64_t before = isFixed ? begin : near.triangle + passOver(values, some, rows.list);
        values.beginElement(rows.element, begin);
        some.count = end - begin;
        read(values, some, before);
    };
    if (header_.format == PlyFormat::Ascii)
        from(AsciiValues(file_, header_.lineEnd, {near.offset, near.line}));
    else
        from(BinaryValues(file_, header_.format, {near.offset + rows.bytes * begin, 0}));
}

void PlyRanges::readVertices(
    std::uint64_t begin, std::uint64_t end, const VertexLayout& layout, VertexBuffer& out) const {
    const auto read = [&](auto& values, const PlyElement& some, std::uint64_t) {
        readVertexElement(values, some, layout, out);
    };
    readRange(vertexRows(), index().vertices, {begin, end}, read);
    out.flush();
}

bool PlyRanges::readFaces(
    std::uint64_t begin, std::uint64_t end, std::uint64_t vertexCount, const TriangleSink& sink) const {
    bool isRegular = true;
    bool isInSink = false; // whether an error comes from the sink, so that it is passed on to the caller
    const TriangleSink take = [&](const TriangleBlock& block) {
        isRegular = isRegular && !(areTriangles_ && (!block.polygons.empty() || block.notAPolygon > 0));
        if (!isRegular) return;
        isInSink = true;
        sink(block);
        isInSink = false;
    };
    const Rows rows = faceRows();
    const auto read = [&](auto& values, const PlyElement& some, std::uint64_t firstTriangle) {
        TriangleBuffer out(take, firstTriangle);
        readFaceElement(values, some, rows.list, vertexCount, out);
        out.flush();
    };
    try {
        readRange(rows, index().faces, {begin, end}, read);
    } catch (const Error&) {
        if (isInSink) throw;
        return false;
    }
    return isRegular;
}

} // namespace gnomon::read
